// The header as the NetCDF Users Guide specifies it, appendix B, "File Format Specifications".

#include "vtk/netcdf_length.h"

#include "visorder/error.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fstream>
#include <vector>

namespace visorder::detail {

namespace {

/// Sizes are products of whatever the header says; beyond any file they all mean the same.
std::uint64_t saturating_product(std::uint64_t a, std::uint64_t b)
{
    std::uint64_t product = 0;
    return __builtin_mul_overflow(a, b, &product) ? UINT64_MAX : product;
}

std::uint64_t saturating_sum(std::uint64_t a, std::uint64_t b)
{
    return a > UINT64_MAX - b ? UINT64_MAX : a + b;
}

std::uint64_t padded(std::uint64_t bytes)
{
    return saturating_sum(bytes, 3) / 4 * 4;
}

class Header {
public:
    explicit Header(const std::filesystem::path& path)
        : path_(path), file_(path, std::ios::binary), file_length_(std::filesystem::file_size(path))
    {
    }

    std::optional<std::uint64_t> declared_length()
    {
        std::array<char, 4> magic{};
        if (!file_.read(magic.data(), magic.size()) || magic[0] != 'C' || magic[1] != 'D' || magic[2] != 'F')
            return {};
        version_ = magic[3];
        if (version_ != 1 && version_ != 2 && version_ != 5)
            return {};

        records_ = read_count();
        // A writer that streams leaves the number of records open.
        if (records_ == (version_ == 5 ? UINT64_MAX : UINT32_MAX))
            records_ = 0;
        read_dimensions();
        skip_attributes();
        return read_variables();
    }

private:
    [[noreturn]] void fail() const
    {
        throw InputError(fmt::format("{}: cannot be read: its netCDF header is cut short or damaged", path_.string()));
    }

    std::uint64_t read_integer(int bytes)
    {
        std::array<unsigned char, 8> data{};
        if (!file_.read(reinterpret_cast<char*>(data.data()), bytes))
            fail();
        std::uint64_t value = 0;
        for (int i = 0; i < bytes; ++i)
            value = value << 8 | data[static_cast<std::size_t>(i)];
        return value;
    }

    std::uint64_t read_count() { return read_integer(version_ == 5 ? 8 : 4); }

    void skip(std::uint64_t bytes)
    {
        if (bytes > file_length_ || !file_.seekg(static_cast<std::streamoff>(bytes), std::ios::cur))
            fail();
    }

    /// How many entries the list has that starts here.
    std::uint64_t read_list()
    {
        file_.ignore(4); // which list it is
        const std::uint64_t entries = read_count();
        if (entries > file_length_) // each takes bytes
            fail();
        return entries;
    }

    void skip_name() { skip(padded(read_count())); }

    std::uint64_t read_type_size()
    {
        constexpr std::array<std::uint8_t, 12> sizes{0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
        const std::uint64_t type = read_integer(4);
        if (type == 0 || type >= sizes.size())
            fail();
        return sizes[type];
    }

    void read_dimensions()
    {
        for (std::uint64_t left = read_list(); left > 0; --left) {
            skip_name();
            dimensions_.push_back(read_count());
        }
    }

    void skip_attributes()
    {
        for (std::uint64_t left = read_list(); left > 0; --left) {
            skip_name();
            const std::uint64_t type_size = read_type_size();
            skip(padded(saturating_product(read_count(), type_size)));
        }
    }

    /// The end of the variable that ends last.
    std::uint64_t read_variables()
    {
        struct RecordVariable {
            std::uint64_t begin;
            std::uint64_t bytes; // in one record
        };
        std::vector<RecordVariable> record_variables;
        std::uint64_t end = 0;
        for (std::uint64_t left = read_list(); left > 0; --left) {
            skip_name();
            bool is_record = false;
            std::uint64_t values = 1;
            for (std::uint64_t rank = read_count(), i = 0; i < rank; ++i) {
                const std::uint64_t dimension = read_count();
                if (dimension >= dimensions_.size())
                    fail();
                if (i == 0 && dimensions_[dimension] == 0)
                    is_record = true; // length 0 stands for the number of records
                else
                    values = saturating_product(values, dimensions_[dimension]);
            }
            skip_attributes();
            const std::uint64_t bytes = saturating_product(values, read_type_size());
            read_count(); // the size again, which overflows for large variables
            const std::uint64_t begin = read_integer(version_ == 1 ? 4 : 8);
            if (is_record)
                record_variables.push_back({begin, bytes});
            else
                end = std::max(end, saturating_sum(begin, bytes));
        }

        if (records_ == 0)
            return end;
        std::uint64_t record_bytes = 0;
        for (const RecordVariable& variable : record_variables)
            record_bytes = saturating_sum(record_bytes, padded(variable.bytes));
        if (record_variables.size() == 1)
            record_bytes = record_variables.front().bytes; // records of a single variable are packed
        for (const RecordVariable& variable : record_variables) {
            const std::uint64_t last_record = saturating_product(records_ - 1, record_bytes);
            end = std::max(end, saturating_sum(saturating_sum(variable.begin, last_record), variable.bytes));
        }
        return end;
    }

    const std::filesystem::path& path_;
    std::ifstream file_;
    std::uint64_t file_length_;
    int version_ = 0;
    std::uint64_t records_ = 0;
    std::vector<std::uint64_t> dimensions_;
};

} // namespace

std::optional<std::uint64_t> declared_netcdf_length(const std::filesystem::path& path)
{
    return Header(path).declared_length();
}

} // namespace visorder::detail
