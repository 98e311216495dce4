#include "files/file_content.h"

#include "files/mapped_file.h"
#include "visorder/error.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <limits>
#include <zlib.h>

namespace visorder::detail {

namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what)
{
    throw InputError(fmt::format("{}: {}", path.string(), what));
}

/// zlib's state, which has to be freed.
class Inflation {
public:
    Inflation()
    {
        constexpr int gzip_alone = 16 + MAX_WBITS;
        ready_ = inflateInit2(&stream, gzip_alone) == Z_OK;
    }
    ~Inflation()
    {
        if (ready_)
            inflateEnd(&stream);
    }
    Inflation(const Inflation&) = delete;
    Inflation& operator=(const Inflation&) = delete;

    bool is_ready() const { return ready_; }

    z_stream stream{};

private:
    bool ready_ = false;
};

} // namespace

std::string content_of_file(const std::filesystem::path& path)
{
    return std::string(MappedFile(path).content());
}

std::string decompressed(const std::filesystem::path& path, std::string_view gzip)
{
    // gzip makes zeros a thousand times smaller, but no mesh so much.
    const std::size_t most = (std::size_t{256} << 20) + 50 * gzip.size();
    Inflation inflation;
    if (!inflation.is_ready())
        fail(path, "cannot be decompressed: zlib cannot start");
    std::string result;
    std::array<char, 1 << 16> buffer{};
    std::size_t at = 0;
    int state = Z_OK;
    while (at < gzip.size() || state == Z_OK) {
        if (state == Z_STREAM_END) { // another member, or padding
            if (gzip.find_first_not_of('\0', at) == std::string_view::npos)
                break;
            inflateReset(&inflation.stream);
        }
        const std::size_t input = std::min<std::size_t>(gzip.size() - at, std::numeric_limits<uInt>::max());
        inflation.stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(gzip.data() + at));
        inflation.stream.avail_in = static_cast<uInt>(input);
        inflation.stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
        inflation.stream.avail_out = static_cast<uInt>(buffer.size());
        state = inflate(&inflation.stream, Z_NO_FLUSH);
        at += input - inflation.stream.avail_in;
        if (state == Z_BUF_ERROR)
            fail(path, "cannot be decompressed: it is cut short");
        if (state != Z_OK && state != Z_STREAM_END)
            fail(path, fmt::format("cannot be decompressed: not gzip, or damaged at byte {}", at));
        result.append(buffer.data(), buffer.size() - inflation.stream.avail_out);
        if (result.size() > most)
            fail(path, fmt::format("cannot be decompressed: it holds more than {} bytes", most));
    }
    return result;
}

} // namespace visorder::detail
