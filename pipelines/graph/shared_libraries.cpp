// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/graph/shared_libraries.h"

#include "formats/base/regular_file.h"
#include "formats/base/temp_directory.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <elf.h>
#include <optional>
#include <set>
#include <unistd.h>

namespace hearth::graph
{

namespace
{

// no table of an executable in use is larger
constexpr uint64_t kMaxBytes = uint64_t{64} << 20;

class ElfFile
{
public:
    explicit ElfFile(const std::string& path) : file_(path) {}

    template <typename T>
    std::vector<T> read(uint64_t offset, uint64_t count) const
    {
        if (!file_.isOpen() || count > kMaxBytes / sizeof(T))
            return {};
        std::vector<T> records(count);
        const auto size = static_cast<ssize_t>(count * sizeof(T));
        return ::pread(file_.descriptor(), records.data(), count * sizeof(T), static_cast<off_t>(offset)) ==
                       size
                   ? records
                   : std::vector<T>();
    }

private:
    RegularFile file_;
};

struct DynamicSection
{
    std::vector<std::string> needed; ///< names
    std::string run_path;
};

/// Return the file offset of an address of the loaded program.
std::optional<uint64_t> fileOffset(uint64_t address, const std::vector<Elf64_Phdr>& segments)
{
    for (const Elf64_Phdr& segment : segments)
        if (segment.p_type == PT_LOAD && address >= segment.p_vaddr &&
            address - segment.p_vaddr < segment.p_filesz)
            return segment.p_offset + (address - segment.p_vaddr);
    return std::nullopt;
}

DynamicSection readDynamicSection(const std::string& path)
{
    const ElfFile file(path);
    const std::vector<Elf64_Ehdr> header = file.read<Elf64_Ehdr>(0, 1);
    if (header.empty() || std::memcmp(header[0].e_ident, ELFMAG, SELFMAG) != 0 ||
        header[0].e_ident[EI_CLASS] != ELFCLASS64)
        return {};
    const auto segments = file.read<Elf64_Phdr>(header[0].e_phoff, header[0].e_phnum);
    std::vector<Elf64_Dyn> entries;
    for (const Elf64_Phdr& segment : segments)
        if (segment.p_type == PT_DYNAMIC)
            entries = file.read<Elf64_Dyn>(segment.p_offset, segment.p_filesz / sizeof(Elf64_Dyn));

    uint64_t strings_address = 0;
    uint64_t strings_size = 0;
    for (const Elf64_Dyn& entry : entries)
    {
        strings_address = entry.d_tag == DT_STRTAB ? entry.d_un.d_ptr : strings_address;
        strings_size = entry.d_tag == DT_STRSZ ? entry.d_un.d_val : strings_size;
    }
    const std::optional<uint64_t> offset = fileOffset(strings_address, segments);
    std::vector<char> strings = offset ? file.read<char>(*offset, strings_size) : std::vector<char>();
    strings.push_back('\0');
    const auto text = [&](uint64_t at)
    { return at < strings.size() ? std::string(strings.data() + at) : std::string(); };
    DynamicSection dynamic;
    for (const Elf64_Dyn& entry : entries)
        if (entry.d_tag == DT_NEEDED)
            dynamic.needed.push_back(text(entry.d_un.d_val));
        else if (entry.d_tag == DT_RUNPATH || entry.d_tag == DT_RPATH)
            dynamic.run_path = text(entry.d_un.d_val);
    return dynamic;
}

void addFolders(std::vector<std::string>& folders, const std::string& list, const std::string& origin)
{
    for (size_t at = 0; at < list.size();)
    {
        const size_t end = std::min(list.find(':', at), list.size());
        std::string folder = list.substr(at, end - at);
        for (const std::string name : {"$ORIGIN", "${ORIGIN}"})
            if (const size_t found = folder.find(name); found != std::string::npos)
                folder.replace(found, name.size(), origin);
        folders.push_back(std::move(folder));
        at = end + 1;
    }
}

std::optional<std::string> find(const std::string& name, const std::vector<std::string>& folders)
{
    for (const std::string& folder : folders)
        if (std::string path = folder + "/" + name; ::access(path.c_str(), R_OK) == 0)
            return path;
    return std::nullopt;
}

void addLibraries(const std::string& path, std::set<std::string>& found)
{
    const DynamicSection dynamic = readDynamicSection(path);
    std::vector<std::string> folders;
    const char* variable = std::getenv("LD_LIBRARY_PATH");
    addFolders(folders, variable == nullptr ? "" : variable, "");
    addFolders(folders, dynamic.run_path, parentFolder(path));
    folders.insert(folders.end(), {"/usr/local/lib", "/lib/x86_64-linux-gnu", "/usr/lib/x86_64-linux-gnu",
                                   "/lib64", "/usr/lib64", "/lib", "/usr/lib"});
    for (const std::string& name : dynamic.needed)
        if (const auto library = find(name, folders); library && found.insert(*library).second)
            addLibraries(*library, found);
}

} // namespace

std::vector<std::string> findLibraries(const std::string& executable)
{
    std::set<std::string> found;
    addLibraries(executable, found);
    return {found.begin(), found.end()};
}

} // namespace hearth::graph
