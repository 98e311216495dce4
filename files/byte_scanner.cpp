#include "files/byte_scanner.h"

#include "visorder/error.h"

#include <fmt/format.h>

namespace visorder::detail {

void ByteScanner::fail(const std::string& what) const
{
    throw InputError(fmt::format("{}: byte {}: {}", path_.string(), at_, what));
}

void ByteScanner::expect_room(std::uint64_t count, std::size_t bytes_each, const char* what) const
{
    if (count > remaining() / bytes_each)
        fail(fmt::format("{} {} are more than the rest of the file has room for", count, what));
}

} // namespace visorder::detail
