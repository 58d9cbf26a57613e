#include <algorithm>
#include <memory>

#include "../backend.h"
#include "../commands.h"
#include "../options.h"
#include "gpu_roofline.h"
#include "natator/error.h"
#include "roofline.h"
#include "study_options.h"

namespace natator::cli {

using namespace natator::bench;

void add_roofline(CLI::App& app, int& status) {
    struct Options {
        StudyOptions common;
        BackendChoice backend;
    };
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "roofline",
        "How near the stages come to what the processor can do: measured roofs, counted operations. On a GPU: "
        "how near those of scheme conserving come to loops that only fetch.");
    command->add_option("--scheme", options->common.schemes, "flex, conserving; the latter alone on a GPU.")
        ->check(one_of({"flex", "conserving"}))
        ->capture_default_str();
    command->add_option("--output,-o", options->common.output,
                        "CSV file; rows that it holds already are kept. Default: standard output.");
    command->add_flag("--quick", options->common.quick, "A few frames only.");
    add_backend_options(command, options->backend);
    command->callback([options, &status] {
        const StudyOptions& common = options->common;
        if (on_gpu(options->backend, {})) {
            if (std::ranges::count(common.schemes, "conserving") == 0)
                throw InputError("--scheme = flex: must be conserving on a GPU");
            ResultTable table(common.output, gpu_roofline_columns(), gpu_roofline_key_columns);
            run_gpu_roofline_study({.device = options->backend.device, .quick = common.quick}, table, report);
            finish(common, table);
            status = ok;
            return;
        }
        RooflineStudy study{.schemes = common.chosen_schemes()};
        if (common.quick) study.frames = 2;
        ResultTable table(common.output, roofline_columns(), roofline_key_columns);
        run_roofline_study(study, table, report);
        finish(common, table);
        status = ok;
    });
}

}  // namespace natator::cli
