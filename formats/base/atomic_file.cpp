// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/atomic_file.h"

#include "formats/base/flush.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sys/stat.h>
#include <unistd.h>

namespace hearth
{

namespace
{

Error cannotWrite(const std::string& path)
{
    return {Issue::cannot_write, path, "", std::string("cannot write: ") + std::strerror(errno)};
}

} // namespace

AtomicFile::AtomicFile(std::string path, std::string temporary_path, std::FILE* file)
    : path_(std::move(path)), temporary_path_(std::move(temporary_path)), file_(file)
{
}

Result<AtomicFile> AtomicFile::create(const std::string& path)
{
    std::string temporary_path = path + ".tmp-XXXXXX";
    const int descriptor = ::mkstemp(temporary_path.data());
    if (descriptor < 0)
        return cannotWrite(path);
    return AtomicFile(path, temporary_path, ::fdopen(descriptor, "wb"));
}

AtomicFile::~AtomicFile()
{
    if (file_)
        ::unlink(temporary_path_.c_str());
}

void AtomicFile::write(std::span<const std::byte> bytes)
{
    failed_ = failed_ || std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size();
}

Status AtomicFile::finish()
{
    // mkstemp makes a private file; an output gets the permissions of the user's umask
    const mode_t mask = ::umask(0);
    ::umask(mask);
    const int descriptor = ::fileno(file_.get());
    if (failed_ || std::fflush(file_.get()) != 0 || ::fchmod(descriptor, 0666 & ~mask) != 0 ||
        !flushFile(descriptor) || ::rename(temporary_path_.c_str(), path_.c_str()) != 0)
        return cannotWrite(path_);
    file_.reset();
    return success();
}

Status writeText(const std::string& path, std::string_view text)
{
    if (path == "-")
        return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0
                   ? success()
                   : Error{Issue::read_failed, "stdout", "", "cannot be written"};
    HEARTH_ASSIGN_OR_RETURN(AtomicFile file, AtomicFile::create(path));
    file.write(text);
    return file.finish();
}

} // namespace hearth
