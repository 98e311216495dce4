#include "files/mapped_file.h"

#include "visorder/error.h"

#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace visorder::detail {

MappedFile::MappedFile(const std::filesystem::path& path)
{
    const auto fail = [&](const std::string& what) { throw InputError(fmt::format("{}: {}", path.string(), what)); };
    const int file =
        open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK); // a pipe that nobody writes to does not block
    if (file < 0)
        fail(fmt::format("cannot be opened: {}", std::generic_category().message(errno)));
    struct stat status = {};
    const bool regular = fstat(file, &status) == 0 && S_ISREG(status.st_mode);
    size_ = regular ? static_cast<std::size_t>(status.st_size) : 0;
    if (size_ > 0)
        data_ = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file, 0);
    close(file);
    if (!regular)
        fail("not a file");
    if (data_ == MAP_FAILED)
        fail("cannot be read: it asks for more memory than there is");
}

MappedFile::~MappedFile()
{
    if (data_)
        munmap(data_, size_);
}

} // namespace visorder::detail
