// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/corpus/opened_files.h"

#include "tests/corpus/open_log.h"

#include <cctype>
#include <filesystem>
#include <fstream>

namespace hearth::corpus
{

namespace
{

/// Normalize a path: "a/../b" becomes "b", because the system does not resolve the path of a failed open.
/// "/proc/<number>" becomes "/proc/self".
std::string plain(const std::string& path)
{
    std::string result = std::filesystem::path(path).lexically_normal().string();
    constexpr std::string_view kProcesses = "/proc/";
    size_t end = kProcesses.size();
    while (result.starts_with(kProcesses) && end < result.size() &&
           std::isdigit(static_cast<unsigned char>(result[end])) != 0)
        ++end;
    if (end > kProcesses.size())
        result.replace(kProcesses.size(), end - kProcesses.size(), "self");
    return result;
}

bool isIn(const std::string& path, const std::string& folder)
{
    return path == folder || path.starts_with(folder + "/");
}

/// True for files that can hold data. /dev/null cannot.
bool isFile(const OpenedFile& file)
{
    return file.kind != kOpenNetwork && file.path != "/dev/null";
}

} // namespace

std::vector<OpenedFile> readOpenLog(const std::string& path)
{
    std::vector<OpenedFile> opened;
    std::ifstream log(path, std::ios::binary);
    for (std::string record; std::getline(log, record, '\0');)
        if (!record.empty())
        {
            const std::string text = record.substr(1);
            opened.push_back({record[0], record[0] == kOpenNetwork ? text : plain(text)});
        }
    return opened;
}

std::set<std::string> filesElsewhere(const std::vector<OpenedFile>& opened, const std::string& asset_folder,
                                     const std::string& box, const std::string& programs)
{
    std::set<std::string> elsewhere;
    for (const OpenedFile& file : opened)
        if (isFile(file) && !isIn(file.path, asset_folder) && !isIn(file.path, box) &&
            !isIn(file.path, programs))
            elsewhere.insert(file.path);
    return elsewhere;
}

std::vector<std::string> trespasses(const std::vector<OpenedFile>& opened, const std::string& asset_folder,
                                    const std::string& box, const AllowedFiles& allowed)
{
    std::set<std::string> sentences;
    for (const OpenedFile& file : opened)
    {
        if (file.kind == kOpenNetwork)
            sentences.insert("connects to " + file.path);
        else if (file.kind == kOpenForWriting && !isIn(file.path, box) && isFile(file))
            sentences.insert("writes to " + file.path);
    }
    for (const std::string& path : filesElsewhere(opened, asset_folder, box, allowed.programs))
        if (!allowed.system.contains(path))
            sentences.insert("opens " + path + ", which is outside the asset's folder");
    return {sentences.begin(), sentences.end()};
}

} // namespace hearth::corpus
