#pragma once

#include <filesystem>
#include <string_view>

namespace visorder::detail {

/// The content of a regular file, mapped into memory as long as this lives.
class MappedFile {
public:
    /// Throws InputError, naming the file, for one that cannot be opened, and for a folder, device or pipe, which may
    /// never end; it waits for none of them.
    explicit MappedFile(const std::filesystem::path& path);
    ~MappedFile();
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;

    std::string_view content() const { return {static_cast<const char*>(data_), size_}; }

private:
    void* data_ = nullptr;
    std::size_t size_ = 0;
};

} // namespace visorder::detail
