#pragma once

#include <string>

namespace natator::cli {

/// Says before anything is computed that a file can't be written, by std::runtime_error. It is opened when there is
/// something to write: what is refused until then leaves it as it was.
void require_writable(const std::string& path);

}  // namespace natator::cli
