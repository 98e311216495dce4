#pragma once

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>

namespace visorder::tests {

/// Bytes of a binary file, of either byte order.
class ByteWriter {
public:
    explicit ByteWriter(std::endian order = std::endian::little) : swapped_(order != std::endian::native) {}

    template <class T>
    ByteWriter& put(T value)
    {
        std::string raw(sizeof(T), '\0');
        std::memcpy(raw.data(), &value, sizeof(T));
        if (swapped_)
            std::reverse(raw.begin(), raw.end());
        bytes_ += raw;
        return *this;
    }
    template <class T, class... Values>
    ByteWriter& put_all(Values... values)
    {
        (put(static_cast<T>(values)), ...);
        return *this;
    }
    ByteWriter& text(const std::string& text)
    {
        bytes_ += text;
        return *this;
    }
    const std::string& bytes() const { return bytes_; }

private:
    bool swapped_;
    std::string bytes_;
};

} // namespace visorder::tests
