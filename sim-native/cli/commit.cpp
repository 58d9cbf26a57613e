#include "commit.h"

#include "natator_commit.h"  // written at build time: see commit.cmake

namespace natator::cli {

const char* commit() {
    return NATATOR_COMMIT;
}

}  // namespace natator::cli
