#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace visorder::detail {

/// An element of a VTK XML file.
struct XmlElement {
    std::string name;
    std::map<std::string, std::string> attributes;
    std::vector<XmlElement> children;
    std::size_t position = 0; ///< of its opening tag in the file

    /// Its attribute of that name; "" if it has none.
    const std::string& attribute(const std::string& attribute_name) const;
    /// The same as a whole number; nothing if there is none. VTK takes the number at the beginning of the text.
    std::optional<std::int64_t> number(const std::string& attribute_name) const;
};

/// The elements of a VTK XML file, up to where appended data begins.
struct XmlTree {
    XmlElement root;
    std::size_t appended = 0; ///< position of the appended data, past the _ before it; 0 if there is none
};

/// Nothing for what is not XML. Throws InputError where elements are more, or nested deeper, than VTK's files have
/// them.
std::optional<XmlTree> xml_tree(std::string_view content);

} // namespace visorder::detail
