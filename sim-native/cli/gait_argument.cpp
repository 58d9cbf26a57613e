#include "gait_argument.h"

#include "json_argument.h"
#include "natator/error.h"
#include "scene/gait_json.h"

namespace natator::cli {

/// The winner of an evolution may have a body of its own, which would be lost if its gait alone were read here.
Gait read_gait_argument(const std::string& argument) {
    const nlohmann::json value = read_json_argument(argument, "--gait");
    const std::string name = json_argument_name(argument, "--gait");
    if (value.is_object() && value.contains("gait"))
        throw InputError(
            name +
            ": has its gait under \"gait\", as the winner of an evolution; must be the gait alone; natator evaluate "
            "--gait takes either");
    return parse_gait(value, name);
}

}  // namespace natator::cli
