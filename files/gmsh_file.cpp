// After Gmsh's manual, sections "MSH file format" and "Legacy formats".

#include "files/gmsh_file.h"

#include "files/gmsh_element.h"
#include "files/gmsh_input.h"
#include "files/printable.h"
#include "files/time_step.h"
#include "visorder/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <unordered_map>

namespace visorder::detail {

namespace {

/// Points and elements have numbers of their own ("tags") in the file.
using Tags = std::unordered_map<std::int64_t, std::size_t>;

/// The values of one view at one time step.
struct Values {
    std::string name;
    bool on_cells;
    double time;
    int components;
    std::vector<std::pair<std::int64_t, double>> of_tags; // magnitudes
};

class GmshParser {
public:
    GmshParser(const std::filesystem::path& path, std::string_view content) : input_(path, content)
    {
        grid_.path = path;
    }

    FileGrid run(const std::string& time)
    {
        bool is_gmsh = false;
        for (std::string_view word = input_.text().word(); !word.empty(); word = input_.text().word()) {
            if (word.front() != '$')
                input_.fail(is_gmsh ? fmt::format("\"{}\" stands where a section should", printable(word))
                                    : "not a Gmsh mesh, which begins with $MeshFormat");
            const std::string name(word.substr(1));
            if (!is_gmsh && name != "MeshFormat" && name != "NOD" && name != "Comments")
                input_.fail("not a Gmsh mesh, which begins with $MeshFormat");
            is_gmsh = true;
            read_section(name);
        }
        find_corners();
        add_arrays(time);
        return std::move(grid_);
    }

private:
    void read_section(const std::string& name)
    {
        if (name == "MeshFormat") {
            read_format();
        } else if (name == "NOD" || name == "Nodes") {
            if (name == "Nodes" && version_ >= 4)
                read_nodes_of_entities();
            else
                read_nodes();
        } else if (name == "ELM") {
            read_elements_1();
        } else if (name == "Elements") {
            if (version_ >= 4)
                read_elements_of_entities();
            else
                read_elements_2();
        } else if (name == "NodeData" || name == "ElementData") {
            read_values(name == "ElementData");
        }
        input_.end_binary();
        input_.skip_section(name == "NOD" || name == "ELM" ? "$END" + name : "$End" + name);
    }

    void read_format()
    {
        version_ = input_.text().real("the version");
        const bool known = (version_ >= 2 && version_ < 3) || version_ == 4.0 || version_ == 4.1;
        if (!known)
            input_.fail(fmt::format("version {} of Gmsh's format is not read; 2.2, 4.0 and 4.1 are", version_));
        const bool binary = input_.text().integer("the kind of file") != 0;
        const std::int64_t size = input_.text().integer("the size of a number");
        if (!binary)
            return;
        if (size != sizeof(double))
            input_.fail(fmt::format("numbers of {} bytes are not read", size));
        input_.set_binary(false);
        input_.begin_binary();
        const std::int64_t one = input_.integer();
        if (one != 1 && one != 0x01000000)
            input_.fail("the byte order cannot be told");
        input_.set_binary(one != 1);
    }

    void add_node(std::int64_t tag)
    {
        const double x = input_.real();
        const double y = input_.real();
        const double z = input_.real();
        nodes_.emplace(tag, grid_.points.size());
        grid_.points.emplace_back(x, y, z);
    }

    /// Versions 1 and 2.
    void read_nodes()
    {
        const std::int64_t count = input_.text().integer("the number of nodes");
        input_.begin_binary();
        for (std::size_t left = input_.checked_count(count, 4, 4 + 24); left > 0; --left)
            add_node(input_.integer());
    }

    /// Version 4.0 gives the number of each node with its coordinates, 4.1 those of a block first.
    void read_nodes_of_entities()
    {
        input_.begin_binary();
        const bool tags_first = version_ > 4.05;
        const std::int64_t block_count = input_.size();
        input_.size(); // nodes
        if (tags_first) {
            input_.size(); // the least
            input_.size(); // and the greatest number
        }
        std::vector<std::int64_t> tags;
        for (std::size_t blocks = input_.checked_count(block_count, 4, 20); blocks > 0; --blocks) {
            const std::int64_t first = input_.integer();
            const std::int64_t second = input_.integer();
            const std::int64_t dimension = tags_first ? first : second;
            const bool parametric = input_.integer() != 0;
            const std::size_t count = input_.checked_count(input_.size(), 4, 28);
            tags.clear();
            for (std::size_t i = 0; tags_first && i < count; ++i)
                tags.push_back(input_.size());
            for (std::size_t i = 0; i < count; ++i) {
                add_node(tags_first ? tags[i] : input_.integer());
                for (std::int64_t k = 0; parametric && k < std::min<std::int64_t>(dimension, 3); ++k)
                    input_.real();
            }
        }
    }

    GmshElement element_of(std::int64_t type) const
    {
        const auto element = gmsh_element(type);
        if (!element)
            input_.fail(fmt::format("elements of type {} are not read", type));
        return *element;
    }

    /// Reads an element's nodes, with `read`, after its tag and type are known.
    template <class Read>
    void add_element(std::int64_t tag, const GmshElement& element, const Read& read)
    {
        elements_.emplace(tag, grid_.cells.size());
        tags_.clear();
        for (std::size_t i = 0; i < element.nodes; ++i) {
            const std::int64_t node = read();
            if (i < element.corners)
                tags_.push_back(node);
        }
        reorder_gmsh_corners(element.shape, tags_);
        grid_.add({element.shape, element.nodes > element.corners}, tags_);
    }

    void read_elements_1()
    {
        for (std::size_t left = input_.text().count("the number of elements", 10); left > 0; --left) {
            const std::int64_t tag = input_.integer();
            const GmshElement element = element_of(input_.integer());
            input_.integer(); // physical
            input_.integer(); // and elementary entity
            if (input_.integer() != static_cast<std::int64_t>(element.nodes))
                input_.fail(fmt::format("element {}: not the {} nodes of its type", tag, element.nodes));
            add_element(tag, element, [&] { return input_.integer(); });
        }
    }

    void read_elements_2()
    {
        const std::int64_t declared = input_.text().integer("the number of elements");
        input_.begin_binary();
        const std::size_t count = input_.checked_count(declared, 4, 8);
        for (std::size_t read = 0; read < count;) {
            if (!input_.is_binary()) {
                const std::int64_t tag = input_.integer();
                const GmshElement element = element_of(input_.integer());
                skip_integers(input_.integer());
                add_element(tag, element, [&] { return input_.integer(); });
                ++read;
                continue;
            }
            const GmshElement element = element_of(input_.integer());
            const std::int64_t in_block = input_.integer();
            const std::int64_t tags = input_.integer();
            if (in_block < 1 || static_cast<std::size_t>(in_block) > count - read)
                input_.fail(fmt::format("a block of {} elements, where {} are left", in_block, count - read));
            for (std::int64_t i = 0; i < in_block; ++i, ++read) {
                const std::int64_t tag = input_.integer();
                skip_integers(tags);
                add_element(tag, element, [&] { return input_.integer(); });
            }
        }
    }

    void skip_integers(std::int64_t count)
    {
        for (std::size_t left = input_.checked_count(count, 1, 4); left > 0; --left)
            input_.integer();
    }

    void read_elements_of_entities()
    {
        input_.begin_binary();
        const bool wide = version_ > 4.05; // numbers of elements and nodes are size_t
        const std::int64_t block_count = input_.size();
        input_.size(); // elements
        if (wide) {
            input_.size(); // the least
            input_.size(); // and the greatest number
        }
        for (std::size_t blocks = input_.checked_count(block_count, 4, 20); blocks > 0; --blocks) {
            input_.integer(); // dimension and number
            input_.integer(); // of the entity
            const GmshElement element = element_of(input_.integer());
            const auto number = [&] { return wide ? input_.size() : input_.integer(); };
            for (std::size_t left = input_.checked_count(input_.size(), 2, 8); left > 0; --left) {
                const std::int64_t tag = number();
                add_element(tag, element, number);
            }
        }
    }

    void read_values(bool on_cells)
    {
        TextScanner& text = input_.text();
        Values values{"", on_cells, 0, 1, {}};
        text.rest_of_line();
        const std::size_t strings = text.count("the number of names");
        text.rest_of_line();
        for (std::size_t i = 0; i < strings; ++i) {
            std::string name(text.rest_of_line());
            std::erase(name, '"');
            if (i == 0)
                values.name = name;
        }
        const std::size_t reals = text.count("the number of times");
        for (std::size_t i = 0; i < reals; ++i)
            if (const double real = text.real("a time"); i == 0 && std::isfinite(real))
                values.time = real;
        const std::size_t integers = text.count("the number of integers");
        std::int64_t count = 0;
        std::int64_t components = 1;
        for (std::size_t i = 0; i < integers; ++i) {
            const std::int64_t integer = text.integer("an integer");
            if (i == 1)
                components = integer;
            if (i == 2)
                count = integer;
        }
        if (components < 1 || components > 9)
            text.fail(fmt::format("values of {} components", components));
        values.components = static_cast<int>(components);
        if (count > 0) {
            input_.begin_binary();
            const auto numbers = static_cast<std::size_t>(components);
            for (std::size_t left = input_.checked_count(count, 1 + numbers, 4 + 8 * numbers); left > 0; --left) {
                const std::int64_t tag = input_.integer();
                double squares = 0;
                double value = 0;
                for (std::size_t k = 0; k < numbers; ++k) {
                    value = input_.real();
                    squares += value * value;
                }
                values.of_tags.emplace_back(tag, components == 1 ? value : std::sqrt(squares));
            }
        }
        views_.push_back(std::move(values));
    }

    /// Puts the places of nodes where their tags stand.
    void find_corners()
    {
        for (std::size_t cell = 0, i = 0; cell < grid_.cells.size(); ++cell)
            for (; i < grid_.ends[cell]; ++i) {
                const auto node = nodes_.find(grid_.corners[i]);
                if (node == nodes_.end())
                    throw InputError(
                        fmt::format("{}: cell {}: there is no node {}", grid_.path.string(), cell, grid_.corners[i]));
                grid_.corners[i] = static_cast<std::int64_t>(node->second);
            }
    }

    void add_arrays(const std::string& time)
    {
        std::vector<double> times;
        for (const Values& values : views_)
            times.push_back(values.time);
        std::sort(times.begin(), times.end());
        times.erase(std::unique(times.begin(), times.end()), times.end());
        const std::size_t step = choose_time_step(grid_.path, times, time, grid_.notes);
        for (Values& values : views_) {
            const bool is_known = std::any_of(grid_.arrays.begin(), grid_.arrays.end(), [&](const FileArray& other) {
                return other.name == values.name && other.on_cells == values.on_cells;
            });
            if (values.time != times[step] || is_known)
                continue;
            const Tags& places = values.on_cells ? elements_ : nodes_;
            std::vector<double> all(values.on_cells ? grid_.cells.size() : grid_.points.size(),
                                    std::numeric_limits<double>::quiet_NaN());
            for (const auto& [tag, value] : values.of_tags)
                if (const auto place = places.find(tag); place != places.end())
                    all[place->second] = value;
            grid_.arrays.push_back({values.name, values.on_cells, values.components, false,
                                    [data = std::make_shared<std::vector<double>>(std::move(all))] { return *data; }});
        }
    }

    GmshInput input_;
    FileGrid grid_;
    double version_ = 1;
    Tags nodes_;
    Tags elements_;
    std::vector<std::int64_t> tags_;
    std::vector<Values> views_;
};

} // namespace

FileGrid read_gmsh_file(const std::filesystem::path& path, std::string_view content, const std::string& time)
{
    return GmshParser(path, content).run(time);
}

} // namespace visorder::detail
