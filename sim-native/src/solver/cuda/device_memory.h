#pragma once

#include <atomic>
#include <cstddef>

namespace natator::cuda {

/// Bytes that the process' DeviceBuffers hold, of all devices.
class DeviceMemory {
public:
    static void take(std::size_t bytes) {
        const std::size_t now = held_ += bytes;
        for (std::size_t peak = peak_; peak < now && !peak_.compare_exchange_weak(peak, now);) {
        }
    }
    static void release(std::size_t bytes) { held_ -= bytes; }

    /// What they take more than at the mark's making, at most since then. Another mark, and what other threads take,
    /// counts in: for measurements of one thing at a time.
    class Mark {
    public:
        Mark() : before_(held_) { peak_ = before_; }
        std::size_t peak() const {
            const std::size_t peak = peak_;
            return peak > before_ ? peak - before_ : 0;
        }

    private:
        std::size_t before_;
    };

private:
    inline static std::atomic<std::size_t> held_{0}, peak_{0};
};

}  // namespace natator::cuda
