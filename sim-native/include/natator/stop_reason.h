#pragma once

namespace natator {

/// Why an evaluation ended.
enum class StopReason { completed, touched_plane, no_progress, unstable, reached };

}  // namespace natator
