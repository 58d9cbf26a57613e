#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>

namespace natator {

/// A message that grows: letters, a length that is set at the end, a body.
class MessageWriter {
public:
    explicit MessageWriter(std::string_view letters) : bytes_(letters) { add<std::uint32_t>(0); }

    template <class T>
    void add(T value) {
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    void add_text(std::string_view text) { bytes_ += text; }
    template <class Vectors>
    void add_vectors(const Vectors& vectors) {
        for (const auto& vector : vectors)
            for (const auto component : vector) add(static_cast<float>(component));
    }
    template <class Numbers>
    void add_numbers(const Numbers& numbers) {
        for (const auto number : numbers) add(static_cast<float>(number));
    }
    void reserve(std::size_t size) { bytes_.reserve(size); }

    /// The bytes, filled up with spaces to a multiple of 4.
    std::string finish() {
        while (bytes_.size() % 4 != 0) bytes_ += ' ';
        const std::size_t length = bytes_.size() - head;
        if (length > UINT32_MAX) throw std::runtime_error("a message of the stream is larger than 4 GiB");
        const auto stored = static_cast<std::uint32_t>(length);
        std::memcpy(bytes_.data() + 4, &stored, sizeof stored);
        return std::move(bytes_);
    }

private:
    static constexpr std::size_t head = 8;
    std::string bytes_;
};

}  // namespace natator
