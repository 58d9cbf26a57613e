#pragma once

#include <string>

#include "natator/error.h"

namespace natator::test {

/// What `work` is refused with by an InputError; empty if it is not.
template <class Work>
std::string refusal_of(const Work& work) {
    try {
        work();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace natator::test
