#include "vtk/xml_piece_arrays.h"

#include "files/file_content.h"

#include <string_view>

namespace visorder::detail {

namespace {

/// The value of an attribute of a tag; empty without it.
std::string value_of(std::string_view tag, std::string_view attribute)
{
    for (std::size_t at = tag.find(attribute); at != std::string_view::npos; at = tag.find(attribute, at + 1)) {
        const std::size_t equals = tag.find_first_not_of(" \t\r\n", at + attribute.size());
        if (at == 0 || std::string_view(" \t\r\n").find(tag[at - 1]) == std::string_view::npos ||
            equals == std::string_view::npos || tag[equals] != '=')
            continue;
        const std::size_t quote = tag.find_first_of("\"'", equals);
        if (quote == std::string_view::npos)
            return {};
        const std::size_t end = tag.find(tag[quote], quote + 1);
        return end == std::string_view::npos ? std::string() : std::string(tag.substr(quote + 1, end - quote - 1));
    }
    return {};
}

/// A name in which XML's own characters are written out.
std::string unescaped(std::string text)
{
    struct Entity {
        std::string_view written;
        char character;
    };
    for (const auto& [written, character] :
         {Entity{"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}, {"&amp;", '&'}})
        for (std::size_t at = text.find(written); at != std::string::npos; at = text.find(written, at + 1))
            text.replace(at, written.size(), 1, character);
    return text;
}

bool is_tag(std::string_view tag, std::string_view name)
{
    return tag.starts_with(name) &&
           (tag.size() == name.size() || std::string_view(" \t\r\n/").find(tag[name.size()]) != std::string_view::npos);
}

} // namespace

std::vector<XmlPieceArrays> xml_piece_arrays(const std::filesystem::path& path)
{
    const std::string content = content_of_file(path);
    const std::string_view text = content;
    std::vector<XmlPieceArrays> pieces;
    std::vector<std::string>* names = nullptr; // where the arrays of the element at hand belong
    for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<', at + 1)) {
        const std::size_t end = text.find('>', at);
        if (end == std::string_view::npos)
            break;
        const std::string_view tag = text.substr(at + 1, end - at - 1);
        if (is_tag(tag, "AppendedData"))
            break;
        if (is_tag(tag, "Piece")) {
            pieces.emplace_back();
            names = nullptr;
        } else if (is_tag(tag, "PointData")) {
            names = pieces.empty() ? nullptr : &pieces.back().of_points;
        } else if (is_tag(tag, "CellData")) {
            names = pieces.empty() ? nullptr : &pieces.back().of_cells;
        } else if (is_tag(tag, "/PointData") || is_tag(tag, "/CellData")) {
            names = nullptr;
        } else if (names && (is_tag(tag, "DataArray") || is_tag(tag, "Array"))) {
            names->push_back(unescaped(value_of(tag, "Name")));
        }
    }
    return pieces;
}

} // namespace visorder::detail
