// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/tools/private_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

namespace hearth::tools
{

Result<PrivateFolder> PrivateFolder::create(const std::string& parent, const std::string& for_output)
{
    std::string path = parent + "/.hearth-XXXXXX";
    if (::mkdtemp(path.data()) == nullptr)
        return Error{Issue::cannot_write, for_output, "",
                     "cannot make a temporary folder in " + parent + ": " + std::strerror(errno)};
    return PrivateFolder(std::move(path));
}

PrivateFolder::~PrivateFolder()
{
    // nothing more can be done about a folder that does not go, and the work itself is done
    std::error_code ignored;
    if (!path_.empty())
        std::filesystem::remove_all(path_, ignored);
}

std::string folderOf(const std::string& path)
{
    const std::string folder = std::filesystem::path(path).parent_path().string();
    return folder.empty() ? "." : folder;
}

std::string temporaryOr(const std::string& otherwise)
{
    const char* temporary = std::getenv("TMPDIR");
    return temporary != nullptr && *temporary != '\0' ? temporary : otherwise;
}

} // namespace hearth::tools
