#pragma once

#include <stdexcept>
#include <string>

namespace natator {

/// Input that can't be used. The message is one line: what, where, and what was expected.
class InputError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

}  // namespace natator
