#include "files/printable.h"
#include "files/time_step.h"
#include "visorder/error.h"
#include "vtk/message_capture.h"
#include "vtk/xml_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fmt/format.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

namespace visorder::detail {

namespace {

/// A file that another one names.
struct Named {
    std::filesystem::path path;
    std::string block;
    double time;
};

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what)
{
    throw InputError(fmt::format("{}: {}", path.string(), what));
}

class Collection {
public:
    Collection(const std::filesystem::path& path, const std::string& type) : path_(path), type_(type) {}

    VtkFile read(const std::string& time)
    {
        find_files();
        VtkFile file{path_, {}, false, {}};
        keep_one_time(time, file.notes);
        const bool several_times = !times_.empty();
        for (const Named& named : files_) {
            VtkFile part = read_named(named, several_times ? "" : time);
            if (!part.parts.empty())
                part.parts.front().block = named.block;
            std::move(part.parts.begin(), part.parts.end(), std::back_inserter(file.parts));
            for (std::string& note : part.notes)
                if (std::find(file.notes.begin(), file.notes.end(), note) == file.notes.end())
                    file.notes.push_back(std::move(note));
        }
        return file;
    }

private:
    bool is_parallel() const { return type_.starts_with('P'); }

    void find_files()
    {
        vtkSmartPointer<vtkXMLDataElement> root;
        run_reader(path_, [&] { root.TakeReference(vtkXMLUtilities::ReadElementFromFile(path_.c_str())); });
        if (!root)
            fail(path_, "cannot be read: not an XML file of VTK, or damaged");
        for (int i = 0; i < root->GetNumberOfNestedElements(); ++i)
            if (vtkXMLDataElement* content = root->GetNestedElement(i); content->GetName() == type_)
                find_files_in(*content, "");
        if (files_.empty())
            fail(path_, "it names no files");
    }

    /// Blocks lie within blocks; no deeper than some number, for elements can be nested as deep as a file is long.
    void find_files_in(vtkXMLDataElement& element, const std::string& outer, int depth = 0)
    {
        constexpr int greatest_depth = 64;
        if (depth > greatest_depth)
            fail(path_, fmt::format("blocks lie within blocks more than {} deep", greatest_depth));
        for (int i = 0; i < element.GetNumberOfNestedElements(); ++i) {
            vtkXMLDataElement& nested = *element.GetNestedElement(i);
            const std::string kind = nested.GetName() ? nested.GetName() : "";
            const char* name = nested.GetAttribute("name");
            const char* index = nested.GetAttribute("index");
            const std::string own = name && *name ? printable(name) : index ? printable(index) : std::to_string(i);
            const std::string block = outer.empty() ? own : fmt::format("{}/{}", outer, own);
            if (kind == "Piece" && is_parallel())
                add(nested.GetAttribute("Source"), "", nullptr);
            else if (kind == "DataSet")
                add(nested.GetAttribute("file"), block, nested.GetAttribute("timestep"));
            else if (kind == "Block" || kind == "Piece" || kind == "Partitions")
                find_files_in(nested, block, depth + 1);
        }
    }

    void add(const char* name, const std::string& block, const char* time)
    {
        if (!name || !*name)
            return; // an empty block
        double at = 0;
        if (type_ == "Collection" && time) {
            const std::string_view text(time);
            std::from_chars(text.data(), text.data() + text.size(), at);
        }
        const std::filesystem::path file = path_.parent_path() / name;
        files_.push_back({file, block.empty() ? printable(name) : block, at});
    }

    void keep_one_time(const std::string& wanted, std::vector<std::string>& notes)
    {
        if (type_ != "Collection")
            return;
        for (const Named& named : files_)
            times_.push_back(named.time);
        std::sort(times_.begin(), times_.end());
        times_.erase(std::unique(times_.begin(), times_.end()), times_.end());
        const double time = times_[choose_time_step(path_, times_, wanted, notes)];
        std::erase_if(files_, [&](const Named& named) { return named.time != time; });
        if (files_.size() == 1)
            files_.front().block.clear();
    }

    VtkFile read_named(const Named& named, const std::string& time) const
    {
        std::error_code error;
        if (!std::filesystem::is_regular_file(named.path, error))
            fail(path_, fmt::format("there is no file {}, which it names", printable(named.path.string())));
        const std::string type = declared_xml_type(named.path);
        if (is_xml_data_set(type) && !(is_parallel() && type.starts_with('P') && type != "PolyData"))
            return read_xml_data_set(named.path, type, time);
        // A block, but no piece, may be in pieces itself.
        if (!is_parallel() && (type == "PUnstructuredGrid" || type == "PPolyData"))
            return read_xml_collection(named.path, type, time);
        fail(named.path, fmt::format("\"{}\" is no kind of VTK file that can be taken as a part of {}", printable(type),
                                     path_.string()));
    }

    const std::filesystem::path& path_;
    const std::string& type_;
    std::vector<Named> files_;
    std::vector<double> times_;
};

} // namespace

VtkFile read_xml_collection(const std::filesystem::path& path, const std::string& type, const std::string& time)
{
    constexpr std::array known{"PUnstructuredGrid",
                               "PPolyData",
                               "vtkMultiBlockDataSet",
                               "vtkPartitionedDataSet",
                               "vtkPartitionedDataSetCollection",
                               "vtkNonOverlappingAMR",
                               "Collection"};
    if (type.empty())
        fail(path, "cannot be read: not an XML file of VTK");
    if (std::find(known.begin(), known.end(), type) == known.end())
        fail(path, fmt::format("\"{}\" is no kind of VTK file that a mesh can be made of", printable(type)));
    return Collection(path, type).read(time);
}

} // namespace visorder::detail
