// Plot3D as its users' manual has it (Walatka et al. 1990, NASA TM-101067), in C's layout or in Fortran's, where each
// record stands between two counts of its bytes. A file does not say which of its layouts it has: its length does.

#include "files/plot3d_layout.h"

#include "files/text_scanner.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>

namespace visorder::detail {

namespace {

constexpr std::size_t block_bytes = 512; // to which some files are padded

struct Layout {
    bool swapped;     ///< of the other byte order than this machine
    bool counted;     ///< begins with the number of grids
    bool fortran;     ///< has counts of bytes around records
    bool doubles;     ///< reals have 8 bytes rather than 4
    bool with_blanks; ///< an integer per point ends a grid, 0 where there is no point
    int axes;
};

/// How many numbers a grid has before its points, and for each.
std::size_t parameters_of(Plot3dContent kind)
{
    return kind == Plot3dContent::grid ? 0 : 4; // Mach number, angle of attack, Reynolds number, time
}
std::size_t reals_of(Plot3dContent kind, int axes)
{
    // Coordinates; or density, momentum, stagnation energy.
    return static_cast<std::size_t>(kind == Plot3dContent::grid ? axes : axes + 2);
}

class BinaryFile {
public:
    BinaryFile(std::string_view bytes, Plot3dContent kind, const Layout& layout)
        : bytes_(bytes), kind_(kind), layout_(layout)
    {
    }

    /// Where the zones' reals and blanks stand, if the file has this layout and is no shorter than it must be.
    bool measure()
    {
        std::size_t zones = 1;
        if (layout_.counted) {
            const bool is_record = begin_record(4);
            const auto count = integer();
            if (!is_record || !count || *count < 1 || static_cast<std::size_t>(*count) > bytes_.size() / 12 ||
                !end_record(4))
                return false;
            zones = static_cast<std::size_t>(*count);
        }
        const std::size_t sizes_bytes = zones * static_cast<std::size_t>(layout_.axes) * 4;
        if (!begin_record(sizes_bytes))
            return false;
        for (std::size_t i = 0; i < zones; ++i)
            if (!read_size())
                return false;
        return end_record(sizes_bytes) && !has_third_size() &&
               std::all_of(sizes_.begin(), sizes_.end(), [&](const glm::ivec3& size) { return measure_zone(size); });
    }

    std::size_t end() const { return at_; }
    const std::vector<glm::ivec3>& sizes() const { return sizes_; }

    Plot3dZones read() const
    {
        Plot3dZones result;
        result.axes = layout_.axes;
        for (std::size_t i = 0; i < sizes_.size(); ++i) {
            Plot3dZone zone;
            zone.size = sizes_[i];
            zone.reals_per_point = static_cast<int>(reals_of(kind_, layout_.axes));
            const std::size_t count = zone.points() * reals_of(kind_, layout_.axes);
            zone.reals.reserve(count);
            for (std::size_t k = 0; k < count; ++k)
                zone.reals.push_back(layout_.doubles ? raw<double>(reals_at_[i] + k * 8)
                                                     : double{raw<float>(reals_at_[i] + k * 4)});
            for (std::size_t k = 0; layout_.with_blanks && k < zone.points(); ++k)
                zone.blank.push_back(raw<std::int32_t>(reals_at_[i] + count * real_bytes() + k * 4) == 0);
            result.zones.push_back(std::move(zone));
        }
        return result;
    }

private:
    std::size_t real_bytes() const { return layout_.doubles ? 8 : 4; }

    template <class T>
    T raw(std::size_t at) const
    {
        std::array<char, sizeof(T)> data{};
        std::memcpy(data.data(), bytes_.data() + at, sizeof(T));
        if (layout_.swapped)
            std::reverse(data.begin(), data.end());
        return std::bit_cast<T>(data);
    }

    std::optional<std::int32_t> integer()
    {
        if (bytes_.size() - at_ < 4)
            return {};
        at_ += 4;
        return raw<std::int32_t>(at_ - 4);
    }

    /// Whether the count of bytes, if there are any, is right.
    bool count_is(std::size_t bytes)
    {
        if (!layout_.fortran)
            return true;
        const auto count = integer();
        return count && static_cast<std::size_t>(static_cast<std::uint32_t>(*count)) == bytes;
    }
    bool begin_record(std::size_t bytes) { return count_is(bytes); }
    bool end_record(std::size_t bytes) { return count_is(bytes); }

    bool read_size()
    {
        glm::ivec3 size(1);
        std::size_t points = 1;
        for (int axis = 0; axis < layout_.axes; ++axis) {
            const auto along = integer();
            if (!along || *along < 1)
                return false;
            size[axis] = *along;
            points *= static_cast<std::size_t>(*along);
            if (points > bytes_.size()) // before the product can overflow
                return false;
        }
        sizes_.push_back(size);
        return true;
    }

    /// Whether a grid of points in a plane would begin with a coordinate that looks like a size: then it is the
    /// beginning of a grid of points in space.
    bool has_third_size() const
    {
        constexpr std::int32_t greatest = 65535;
        if (layout_.axes == 3 || layout_.fortran || bytes_.size() - at_ < 4)
            return false;
        const auto next = raw<std::int32_t>(at_);
        return next >= 1 && next <= greatest;
    }

    bool skip(std::size_t bytes)
    {
        if (bytes_.size() - at_ < bytes)
            return false;
        at_ += bytes;
        return true;
    }

    bool measure_zone(const glm::ivec3& size)
    {
        if (const std::size_t bytes = parameters_of(kind_) * real_bytes();
            bytes > 0 && !(begin_record(bytes) && skip(bytes) && end_record(bytes)))
            return false;
        const auto points =
            static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z);
        const std::size_t bytes =
            points * reals_of(kind_, layout_.axes) * real_bytes() + (layout_.with_blanks ? points * 4 : 0);
        if (!begin_record(bytes))
            return false;
        reals_at_.push_back(at_);
        return skip(bytes) && end_record(bytes);
    }

    std::string_view bytes_;
    Plot3dContent kind_;
    Layout layout_;
    std::size_t at_ = 0;
    std::vector<glm::ivec3> sizes_;
    std::vector<std::size_t> reals_at_;
};

/// Whether what follows the file's content is nothing but padding.
bool is_padding(std::string_view content, std::size_t end)
{
    return (content.size() % block_bytes == 0 && content.size() - end < block_bytes) ||
           content.find_first_not_of('\0', end) == std::string_view::npos;
}

std::vector<Layout> layouts(Plot3dContent kind, int axes)
{
    std::vector<Layout> all;
    for (const int a : {3, 2})
        for (unsigned bits = 0; bits < 32; ++bits)
            if ((axes == 0 || a == axes) && (kind == Plot3dContent::grid || (bits & 16) == 0))
                all.push_back(
                    {(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0, (bits & 16) != 0, a});
    return all;
}

std::optional<Plot3dZones> find_binary(std::string_view content, Plot3dContent kind, int axes)
{
    for (const bool padded : {false, true}) {
        if (padded && kind == Plot3dContent::grid)
            break;
        for (const Layout& layout : layouts(kind, axes)) {
            BinaryFile file(content, kind, layout);
            if (file.measure() && (padded ? is_padding(content, file.end()) : file.end() == content.size()))
                return file.read();
        }
    }
    return {};
}

bool is_text(std::string_view content)
{
    constexpr std::string_view allowed = "0123456789+-.eEdD*, \t\r\n";
    return !content.empty() && content.find_first_not_of(allowed) == std::string_view::npos;
}

/// All numbers of a text as Fortran reads lists of them: separated by blanks or commas, 3*1.5 for three times 1.5.
/// Nothing if there is anything else.
std::optional<std::vector<double>> numbers_of(const std::filesystem::path& path, std::string_view content)
{
    constexpr std::size_t most_repeats = std::size_t{1} << 20;
    std::string text(content);
    std::replace(text.begin(), text.end(), ',', ' ');
    TextScanner scanner(path, text);
    std::vector<double> numbers;
    for (std::string_view word = scanner.word(); !word.empty(); word = scanner.word()) {
        std::size_t repeats = 1;
        if (const std::size_t star = word.find('*'); star != std::string_view::npos) {
            const auto [stop, error] = std::from_chars(word.data(), word.data() + star, repeats);
            if (error != std::errc() || stop != word.data() + star || repeats > most_repeats ||
                numbers.size() > content.size() + most_repeats)
                return {};
            word.remove_prefix(star + 1);
        }
        numbers.insert(numbers.end(), repeats, scanner.real_of(word));
    }
    return numbers;
}

std::optional<Plot3dZones> zones_of(const std::vector<double>& numbers, Plot3dContent kind, const Layout& layout)
{
    std::size_t at = 0;
    const auto integer = [&]() -> int {
        constexpr double greatest = 1 << 30;
        const double value = at < numbers.size() ? numbers[at++] : 0;
        return value >= 1 && value <= greatest && value == static_cast<int>(value) ? static_cast<int>(value) : 0;
    };
    const auto zones = layout.counted ? static_cast<std::size_t>(integer()) : 1;
    if (zones == 0 || zones > numbers.size())
        return {};
    Plot3dZones result;
    result.axes = layout.axes;
    result.zones.resize(zones);
    const std::size_t reals = reals_of(kind, layout.axes);
    for (Plot3dZone& zone : result.zones) {
        zone.reals_per_point = static_cast<int>(reals);
        std::size_t points = 1;
        for (int axis = 0; axis < layout.axes; ++axis) {
            zone.size[axis] = integer();
            points *= static_cast<std::size_t>(zone.size[axis]);
            if (points == 0 || points > numbers.size())
                return {};
        }
    }
    for (Plot3dZone& zone : result.zones) {
        at += parameters_of(kind);
        const std::size_t count = zone.points() * reals;
        if (at > numbers.size() || numbers.size() - at < count + (layout.with_blanks ? zone.points() : 0))
            return {};
        const auto begin = numbers.begin() + static_cast<std::ptrdiff_t>(at);
        zone.reals.assign(begin, begin + static_cast<std::ptrdiff_t>(count));
        at += count;
        for (std::size_t i = 0; layout.with_blanks && i < zone.points(); ++i)
            zone.blank.push_back(numbers[at++] == 0);
    }
    return at == numbers.size() ? std::optional(std::move(result)) : std::nullopt;
}

std::optional<Plot3dZones> find_text(const std::filesystem::path& path, std::string_view content, Plot3dContent kind,
                                     int axes)
{
    const auto numbers = numbers_of(path, content);
    if (!numbers)
        return {};
    for (const Layout& layout : layouts(kind, axes))
        if (!layout.swapped && !layout.fortran && !layout.doubles)
            if (auto zones = zones_of(*numbers, kind, layout))
                return zones;
    return {};
}

} // namespace

std::optional<Plot3dZones> find_plot3d_zones(const std::filesystem::path& path, std::string_view content,
                                             Plot3dContent kind, int axes)
{
    return is_text(content) ? find_text(path, content, kind, axes) : find_binary(content, kind, axes);
}

} // namespace visorder::detail
