#pragma once

#include <exception>
#include <new>
#include <stdexcept>
#include <string>

namespace natator {

/// Input that can't be used. The message is one line: what, where, and what was expected.
class InputError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// A device or backend that was asked for and is not there. The message is one line.
class NoDevice : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// What an exception says, in words for users.
inline std::string message_of(const std::exception& error) {
    return dynamic_cast<const std::bad_alloc*>(&error) != nullptr ? "out of memory" : error.what();
}

}  // namespace natator
