#include "settled_state_key.h"

#include <span>

#include "base/byte_writer.h"
#include "base/system.h"
#include "model/model_key.h"
#include "natator/instruction_set.h"

namespace natator {

std::string settled_state_key(const Model& model, const Settling& settling, int real_bytes) {
    static const std::string id = system::build_id();
    if (id.empty()) return {};
    ByteWriter key;
    key.add(id), key.add(instruction_set()), key.add(real_bytes);
    const auto& [updates, step, substeps] = settling;
    key.add(updates), key.add(step), key.add(substeps);
    const std::string start = start_key(model);
    key.add_all(std::span(start));
    return key.take();
}

}  // namespace natator
