#pragma once

namespace natator::cli {

/// The commit that this program was built from: 12 hexadecimal digits, "-modified" after them if the sources differed
/// from it, or "unknown".
const char* commit();

}  // namespace natator::cli
