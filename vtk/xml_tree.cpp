#include "vtk/xml_tree.h"

#include "visorder/error.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <sstream>
#include <vtk_expat.h>

namespace visorder::detail {

namespace {

constexpr std::size_t most_elements = 1'000'000;
constexpr std::size_t most_depth = 100; // VTK deletes elements by recursion

class TreeParser {
public:
    TreeParser() : parser_(XML_ParserCreate(nullptr), &XML_ParserFree)
    {
        XML_SetUserData(parser_.get(), this);
        XML_SetElementHandler(parser_.get(), &TreeParser::start, &TreeParser::end);
    }

    /// Whether that is XML, as far as it goes.
    bool parse(std::string_view content)
    {
        constexpr std::size_t piece = std::size_t{1} << 20;
        while (!content.empty()) {
            const std::string_view next = content.substr(0, piece);
            if (XML_Parse(parser_.get(), next.data(), static_cast<int>(next.size()), 0) != XML_STATUS_OK)
                break;
            content.remove_prefix(next.size());
        }
        if (elements_ > most_elements)
            throw InputError(fmt::format("it has more than {} elements", most_elements));
        if (too_deep_)
            throw InputError(fmt::format("its elements are nested more than {} deep", most_depth));
        return content.empty();
    }

    /// The outermost element, whose children are those that have been closed or are still open.
    XmlElement root()
    {
        while (open_.size() > 1)
            close();
        return open_.empty() ? std::move(root_) : std::move(open_.front());
    }

private:
    static void start(void* self, const char* name, const char** attributes)
    {
        static_cast<TreeParser*>(self)->open(name, attributes);
    }
    static void end(void* self, const char*) { static_cast<TreeParser*>(self)->close(); }

    void open(const char* name, const char** attributes)
    {
        if (++elements_ > most_elements || open_.size() >= most_depth) {
            too_deep_ = open_.size() >= most_depth;
            XML_StopParser(parser_.get(), XML_FALSE);
            return;
        }
        XmlElement element;
        element.name = name;
        for (; *attributes; attributes += 2)
            element.attributes.emplace(attributes[0], attributes[1]);
        element.position = static_cast<std::size_t>(XML_GetCurrentByteIndex(parser_.get()));
        open_.push_back(std::move(element));
    }

    void close()
    {
        if (open_.empty())
            return;
        XmlElement finished = std::move(open_.back());
        open_.pop_back();
        (open_.empty() ? root_ : open_.back().children.emplace_back()) = std::move(finished);
    }

    std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser_;
    std::vector<XmlElement> open_;
    XmlElement root_;
    std::size_t elements_ = 0;
    bool too_deep_ = false;
};

} // namespace

const std::string& XmlElement::attribute(const std::string& attribute_name) const
{
    static const std::string none;
    const auto found = attributes.find(attribute_name);
    return found == attributes.end() ? none : found->second;
}

std::optional<std::int64_t> XmlElement::number(const std::string& attribute_name) const
{
    std::istringstream text(attribute(attribute_name));
    std::int64_t value = 0;
    if (!(text >> value))
        return {};
    return value;
}

std::optional<XmlTree> xml_tree(std::string_view content)
{
    // VTK stops parsing where these characters first stand, at the end of the tag.
    const std::size_t appended = content.find("<AppendedData");
    const std::size_t tag_end = appended == std::string_view::npos ? appended : content.find('>', appended);
    TreeParser parser;
    if (!parser.parse(tag_end == std::string_view::npos ? content : content.substr(0, tag_end + 1)))
        return {};
    XmlTree tree{parser.root()};
    if (tag_end != std::string_view::npos) {
        const std::size_t data = std::min(content.find_first_not_of(" \t\r\n\v\f", tag_end + 1), content.size());
        tree.appended = data < content.size() && content[data] == '_' ? data + 1 : data;
    }
    return tree;
}

} // namespace visorder::detail
