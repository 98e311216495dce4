#include "files/mesh_file_bytes.h"

#include "visorder/error.h"

#include <glm/vec3.hpp>
#include <type_traits>
#include <utility>

namespace visorder::detail {

namespace {

// The sizes tell programs apart that were compiled with other fields.
constexpr std::uint64_t layout =
    0x7669736f72640001u + (sizeof(ReadOptions) << 16) + (sizeof(MeshFile) << 24) + (sizeof(MeshBlock) << 32);

// A field that is added and not listed here does not compile.
template <class Archive>
void transfer(Archive& archive, ReadOptions& options)
{
    auto& [scalar, weld, weld_tolerance, time, isolated, list_arrays] = options;
    archive(scalar, weld, weld_tolerance, time, isolated, list_arrays);
}

template <class Archive>
void transfer(Archive& archive, ReadRequest& request)
{
    archive(request.file, request.options, request.memory_bytes, request.processor_seconds);
}

template <class Archive>
void transfer(Archive& archive, MeshBlock& block)
{
    auto& [name, first_file_cell] = block;
    archive(name, first_file_cell);
}

template <class Archive>
void transfer(Archive& archive, ScalarMap& map)
{
    archive(map.offset, map.scale);
}

template <class Archive>
void transfer(Archive& archive, ArraySummary& array)
{
    archive(array.name, array.type, array.on_cells, array.components, array.holds_ids, array.finite, array.missing,
            array.lowest, array.highest);
}

template <class Archive>
void transfer(Archive& archive, Mesh& mesh)
{
    auto& [points, shapes, offsets, vertices, scalars] = mesh;
    archive(points, shapes, offsets, vertices, scalars);
}

template <class Archive>
void transfer(Archive& archive, MeshFile& file)
{
    auto& [mesh, scalar, scalar_map, notes, file_cells, blocks, arrays] = file;
    archive(mesh, scalar, scalar_map, notes, file_cells, blocks, arrays);
}

template <class T>
constexpr bool is_plain = std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, glm::dvec3>;

/// Passes values on, piece by piece.
template <class Write>
class ByteWriter {
public:
    explicit ByteWriter(const Write& write) : write_(write) {}

    template <class... T>
    void operator()(T&... values)
    {
        (one(values), ...);
    }

private:
    template <class T>
    void one(T& value)
    {
        if constexpr (is_plain<T>)
            write_(std::as_bytes(std::span(&value, 1)));
        else
            transfer(*this, value);
    }

    void one(std::string& text)
    {
        count(text.size());
        write_(std::as_bytes(std::span(text)));
    }

    template <class T>
    void one(std::vector<T>& values)
    {
        count(values.size());
        if constexpr (is_plain<T>)
            write_(std::as_bytes(std::span(values)));
        else
            for (T& value : values)
                one(value);
    }

    void count(std::uint64_t n) { one(n); }

    const Write& write_;
};

class ByteReader {
public:
    ByteReader(const ReadBytes& read, std::uint64_t bytes) : read_(read), bytes_left_(bytes) {}

    template <class... T>
    void operator()(T&... values)
    {
        (one(values), ...);
    }

    std::uint64_t bytes_left() const { return bytes_left_; }

    [[noreturn]] static void fail()
    {
        throw InputError("cannot be read: visorder-read is of another version than the library");
    }

private:
    template <class T>
    void one(T& value)
    {
        if constexpr (is_plain<T>)
            copy(&value, sizeof(T));
        else
            transfer(*this, value);
    }

    void one(std::string& text)
    {
        text.resize(count(1));
        copy(text.data(), text.size());
    }

    template <class T>
    void one(std::vector<T>& values)
    {
        values.resize(count(is_plain<T> ? sizeof(T) : 8)); // a string or a block begins with a number
        if constexpr (is_plain<T>)
            copy(values.data(), values.size() * sizeof(T));
        else
            for (T& value : values)
                one(value);
    }

    std::size_t count(std::size_t bytes_each)
    {
        std::uint64_t n = 0;
        one(n);
        if (n > bytes_left_ / bytes_each)
            fail();
        return n;
    }

    void copy(void* to, std::size_t size)
    {
        if (size > bytes_left_)
            fail();
        read_({static_cast<std::byte*>(to), size});
        bytes_left_ -= size;
    }

    const ReadBytes& read_;
    std::uint64_t bytes_left_;
};

// What comes before the fields.
struct Heading {
    std::uint64_t layout;
    std::uint64_t bytes; // of the fields
};

template <class T>
void write_fields(T& value, const WriteBytes& write)
{
    Heading heading{layout, 0};
    const auto add_up = [&](std::span<const std::byte> piece) { heading.bytes += piece.size(); };
    ByteWriter sum(add_up);
    sum(value);
    write(std::as_bytes(std::span(&heading, 1)));
    ByteWriter writer(write);
    writer(value);
}

template <class T>
T read_fields(const ReadBytes& read, std::uint64_t most_bytes)
{
    Heading heading{};
    read(std::as_writable_bytes(std::span(&heading, 1)));
    if (heading.layout != layout || heading.bytes > most_bytes)
        ByteReader::fail();
    ByteReader reader(read, heading.bytes);
    T value{};
    reader(value);
    if (reader.bytes_left() != 0)
        ByteReader::fail();
    return value;
}

/// A result as fields.
struct ResultFields {
    std::uint8_t is_mesh = 0;
    MeshFile mesh;
    std::string error;
};

template <class Archive>
void transfer(Archive& archive, ResultFields& result)
{
    archive(result.is_mesh, result.mesh, result.error);
}

} // namespace

void write_request(ReadRequest request, const WriteBytes& write)
{
    write_fields(request, write);
}

ReadRequest read_request(const ReadBytes& read)
{
    return read_fields<ReadRequest>(read, 1 << 20);
}

void write_result(ReadResult&& result, const WriteBytes& write)
{
    ResultFields fields;
    if (auto* mesh = std::get_if<MeshFile>(&result)) {
        fields.is_mesh = 1;
        fields.mesh = std::move(*mesh);
    } else {
        fields.error = std::get<std::string>(result);
    }
    write_fields(fields, write);
}

ReadResult read_result(const ReadBytes& read, std::uint64_t most_bytes)
{
    auto fields = read_fields<ResultFields>(read, most_bytes);
    if (fields.is_mesh == 1)
        return std::move(fields.mesh);
    return std::move(fields.error);
}

} // namespace visorder::detail
