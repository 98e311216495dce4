#include "files/ply_header.h"

#include "files/printable.h"
#include "files/text_scanner.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace visorder::detail {

namespace {

struct TypeName {
    std::string_view name;
    PlyType type;
};
constexpr std::array type_names{
    TypeName{"char", PlyType::int8},      TypeName{"int8", PlyType::int8},       TypeName{"uchar", PlyType::uint8},
    TypeName{"uint8", PlyType::uint8},    TypeName{"short", PlyType::int16},     TypeName{"int16", PlyType::int16},
    TypeName{"ushort", PlyType::uint16},  TypeName{"uint16", PlyType::uint16},   TypeName{"int", PlyType::int32},
    TypeName{"int32", PlyType::int32},    TypeName{"uint", PlyType::uint32},     TypeName{"uint32", PlyType::uint32},
    TypeName{"float", PlyType::float32},  TypeName{"float32", PlyType::float32}, TypeName{"double", PlyType::float64},
    TypeName{"float64", PlyType::float64}};

PlyType type_named(const TextScanner& scanner, std::string_view name)
{
    const auto* found =
        std::find_if(type_names.begin(), type_names.end(), [&](const TypeName& type) { return type.name == name; });
    if (found == type_names.end())
        scanner.fail(fmt::format("\"{}\" is no type of a property", printable(name)));
    return found->type;
}

PlyProperty read_property(TextScanner& scanner)
{
    PlyProperty property;
    std::string_view type = scanner.word_on_line();
    property.is_list = type == "list";
    if (property.is_list) {
        property.count_type = type_named(scanner, scanner.word_on_line());
        if (property.count_type >= PlyType::float32)
            scanner.fail("the length of a list is no integer");
        type = scanner.word_on_line();
    }
    property.type = type_named(scanner, type);
    property.name = scanner.word_on_line();
    if (property.name.empty())
        scanner.fail("a property without a name");
    return property;
}

PlyHeader::Encoding read_encoding(TextScanner& scanner)
{
    const std::string_view name = scanner.word_on_line();
    if (name == "ascii")
        return PlyHeader::Encoding::text;
    if (name == "binary_little_endian")
        return PlyHeader::Encoding::little_endian;
    if (name == "binary_big_endian")
        return PlyHeader::Encoding::big_endian;
    scanner.fail(fmt::format("\"{}\" is no format of PLY", printable(name)));
}

} // namespace

std::size_t bytes_of(PlyType type)
{
    constexpr std::array<std::size_t, 8> bytes{1, 1, 2, 2, 4, 4, 4, 8};
    return bytes[static_cast<std::size_t>(type)];
}

PlyHeader read_ply_header(const std::filesystem::path& path, std::string_view content)
{
    TextScanner scanner(path, content);
    if (scanner.word_on_line() != "ply" || !scanner.at_end_of_line())
        scanner.fail("not a PLY file");
    PlyHeader header;
    bool has_format = false;
    for (;;) {
        const std::string_view keyword = scanner.word("end_header");
        if (keyword == "end_header")
            break;
        if (keyword == "format") {
            header.encoding = read_encoding(scanner);
            has_format = true;
        } else if (keyword == "element") {
            PlyElement element;
            element.name = scanner.word_on_line();
            const std::int64_t count = scanner.integer_of(scanner.word_on_line());
            if (count < 0)
                scanner.fail(fmt::format("{} elements", count));
            element.count = static_cast<std::uint64_t>(count);
            header.elements.push_back(std::move(element));
        } else if (keyword == "property") {
            if (header.elements.empty())
                scanner.fail("a property of no element");
            header.elements.back().properties.push_back(read_property(scanner));
        } else if (keyword != "comment" && keyword != "obj_info") {
            scanner.fail(fmt::format("\"{}\" is nothing that a PLY header has", printable(keyword)));
        }
        scanner.rest_of_line();
    }
    if (!has_format)
        scanner.fail("the header names no format");
    scanner.rest_of_line();
    header.end = scanner.position();
    return header;
}

} // namespace visorder::detail
