// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/doctor.h"

#include "cook/json/json.h"
#include "cook/tools/child_processes.h"
#include "formats/base/regular_file.h"
#include "formats/base/temp_directory.h"
#include "pipelines/cache/http_store.h"
#include "pipelines/cache/maintenance.h"
#include "pipelines/command/shell/terminal.h"
#include "pipelines/cookers/registry.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <thread>
#include <unistd.h>

namespace hearth::command
{

namespace
{

namespace fs = std::filesystem;
using State = DoctorCheck::State;

// Least free disk space: ten times what a cook of the demo scene writes.
constexpr uint64_t kMinSpace_bytes = uint64_t{1} << 30;
// Memory that cooking one large mesh takes.
constexpr uint64_t kMinMemory_bytes = uint64_t{2} << 30;
// Text before the version in the binary of every program of Hearth (cmake/program_version.cpp.in).
constexpr std::string_view kVersionMark = "hearth program version ";

constexpr const char* kImagesProgram = "/hearth-images";

/// Read the version from a program's binary; empty: it is no program of Hearth.
std::string readProgramVersion(const std::string& program)
{
    const Result<std::string> read = readFile(program);
    const std::string bytes = read ? *read : "";
    // this program contains the mark too, as the constant of this search
    for (size_t at = bytes.find(kVersionMark); at != std::string::npos; at = bytes.find(kVersionMark, at + 1))
    {
        const size_t start = at + kVersionMark.size();
        if (start < bytes.size() && bytes[start] >= '0' && bytes[start] <= '9')
            return bytes.substr(start, bytes.find('\0', start) - start);
    }
    return "";
}

DoctorCheck checkPrograms(const std::string& folder)
{
    std::vector<std::string> missing;
    std::vector<std::string> others;
    std::vector<std::string_view> names;
    for (const cookers::Cooker& cooker : cookers::allCookers())
        if (!cooker.has_package_of_its_own ||
            ::access(fmt::format("{}/hearth-{}", folder, cooker.name).c_str(), X_OK) == 0)
            names.push_back(cooker.name);
    names.emplace_back("render");
    // it may have been left out of the build: checkImages() says what it is for
    if (::access((folder + kImagesProgram).c_str(), X_OK) == 0)
        names.emplace_back("images");
    for (const std::string_view name : names)
    {
        const std::string program = fmt::format("{}/hearth-{}", folder, name);
        const std::string version = readProgramVersion(program);
        if (::access(program.c_str(), X_OK) != 0)
            missing.push_back(fmt::format("hearth-{}", name));
        else if (version != HEARTH_VERSION)
            others.push_back(fmt::format("hearth-{} {}", name, version.empty() ? "of no version" : version));
    }
    if (!missing.empty())
        return {"programs", State::wrong, fmt::format("{} lacks {}", folder, fmt::join(missing, ", ")),
                "install all of Hearth: its programs must be in one folder"};
    if (!others.empty())
        return {"programs", State::wrong,
                fmt::format("this is hearth " HEARTH_VERSION ", beside it are {}", fmt::join(others, ", ")),
                "install Hearth anew: all of its programs come from one build"};
    return {"programs", State::ok, fmt::format("all of " HEARTH_VERSION ", in {}", folder), ""};
}

DoctorCheck checkImages(const std::string& folder)
{
    if (::access((folder + kImagesProgram).c_str(), X_OK) == 0)
        return {"images", State::ok, "TIFF, PSD, JPEG 2000 and all parts of EXR are read", ""};
    return {"images", State::warning, "hearth-images is not there: TIFF, PSD and JPEG 2000 are not read",
            "build Hearth with HEARTH_BUILD_IMAGES, or convert such images to PNG"};
}

/// Return the nearest existing folder, at or above `folder`.
std::string nearestExistingFolder(std::string folder)
{
    std::error_code error;
    while (!folder.empty() && !fs::is_directory(folder, error))
    {
        const std::string parent = fs::path(folder).parent_path().string();
        folder = parent == folder ? "" : parent;
    }
    return folder.empty() ? "." : folder;
}

DoctorCheck checkSpace(const std::string& what, const std::string& folder)
{
    std::error_code error;
    const fs::space_info space = fs::space(nearestExistingFolder(folder), error);
    const std::string text =
        fmt::format("{} free for {} in {}", readableSize(error ? 0 : space.available), what, folder);
    if (error || space.available < kMinSpace_bytes)
        return {"space", State::wrong, text, "make room, or choose another disk: TMPDIR, --cache"};
    return {"space", State::ok, text, ""};
}

/// True if a file can be created in the folder. Tries it, because permissions alone do not tell.
bool canWriteInto(const std::string& folder)
{
    std::string path = nearestExistingFolder(folder) + "/.hearth-doctor-XXXXXX";
    const int file = ::mkstemp(path.data());
    if (file < 0)
        return false;
    ::close(file);
    return ::unlink(path.c_str()) == 0;
}

DoctorCheck checkCache(const cache::CacheSpec& spec)
{
    const cache::Occupancy occupancy = cache::measureOccupancy(spec.place);
    const std::string text =
        fmt::format("{}: {} of {} in {} entries{}", spec.place, readableSize(occupancy.bytes),
                    readableSize(spec.limit_bytes), occupancy.entries, spec.writable ? "" : ", read only");
    std::error_code error;
    if (!spec.writable)
        return fs::is_directory(spec.place, error)
                   ? DoctorCheck{"cache", State::ok, text, ""}
                   : DoctorCheck{"cache", State::wrong, spec.place + " is not there",
                                 "mount it, or take it out of --cache and hearth.toml"};
    if (!canWriteInto(spec.place))
        return {"cache", State::wrong, spec.place + " cannot be written",
                "give yourself rights to it, or choose another: --cache dir:FOLDER"};
    return {"cache", State::ok, text, ""};
}

/// Test a cache server by asking it for a key that no cook has.
DoctorCheck checkServer(const cache::CacheSpec& spec)
{
    cache::HttpStore server(spec.place, false);
    std::vector<cache::EntryRequest> wanted{{std::string(64, '0'), std::nullopt}};
    const Status answered = server.entries(wanted);
    if (answered.ok())
        return {"cache", State::ok, server.name() + " answers" + (spec.writable ? "" : ", read only"), ""};
    return {"cache", State::wrong, server.name() + ": " + answered.error().detail,
            "start it, or take it out of --cache and hearth.toml: cooks go on without it"};
}

std::vector<DoctorCheck> checkCaches(const Result<std::vector<cache::CacheSpec>>& caches)
{
    if (!caches.ok())
        return {{"cache", State::wrong, formatMessage(caches.error()),
                 "correct --cache, HEARTH_CACHE or hearth.toml"}};
    if (caches->empty())
        return {{"cache", State::warning, "no cache is used: every cook runs every cooker",
                 "unset HEARTH_CACHE and HEARTH_CACHE_MODE"}};
    std::vector<DoctorCheck> checks;
    for (const cache::CacheSpec& spec : *caches)
    {
        checks.push_back(spec.is_server ? checkServer(spec) : checkCache(spec));
        if (spec.writable && !spec.is_server)
            checks.push_back(checkSpace("the cache", spec.place));
    }
    return checks;
}

std::string shellQuoted(std::string text)
{
    for (size_t at = 0; (at = text.find('\'', at)) != std::string::npos; at += 4)
        text.replace(at, 1, "'\\''");
    return "'" + text + "'";
}

/// True if a command exits with 0; `line` becomes the last line that it prints.
bool commandSucceeds(const std::string& command, std::string& line)
{
    std::FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
    if (pipe == nullptr)
        return false;
    char buffer[1024];
    while (std::fgets(buffer, sizeof buffer, pipe) != nullptr)
        line = buffer;
    while (line.ends_with('\n'))
        line.pop_back();
    return ::pclose(pipe) == 0;
}

DoctorCheck checkDevice(const std::string& folder)
{
    const std::string program = folder + "/hearth-render";
    if (::access(program.c_str(), X_OK) != 0)
        return {"device", State::wrong, "hearth-render, which would say what draws, is not there",
                "install all of Hearth: its programs must be in one folder"};
    std::string line;
    if (commandSucceeds(shellQuoted(program) + " --name-device", line))
        return {"device", State::ok, "draws with " + line, ""};
    return {"device", State::wrong, line, "install a Vulkan driver: on Debian mesa-vulkan-drivers"};
}

DoctorCheck checkThreads()
{
    const unsigned threads = std::thread::hardware_concurrency();
    return {"threads", State::ok, fmt::format("{} threads", threads), ""};
}

DoctorCheck checkMemory()
{
    const auto page = static_cast<uint64_t>(::sysconf(_SC_PAGESIZE));
    const uint64_t all = static_cast<uint64_t>(::sysconf(_SC_PHYS_PAGES)) * page;
    const uint64_t free = static_cast<uint64_t>(::sysconf(_SC_AVPHYS_PAGES)) * page;
    const std::string text =
        fmt::format("{} of memory, {} of it free at once", readableSize(all), readableSize(free));
    if (all < kMinMemory_bytes)
        return {"memory", State::warning, text, "cook large meshes on another machine, or with --jobs 1"};
    return {"memory", State::ok, text, ""};
}

const char* stateName(State state)
{
    return state == State::ok ? "ok" : state == State::warning ? "warning" : "wrong";
}

} // namespace

std::vector<DoctorCheck> runDoctorChecks(const Result<std::vector<cache::CacheSpec>>& caches)
{
    const std::string folder = tools::programFolder();
    std::vector<DoctorCheck> checks{checkPrograms(folder), checkImages(folder)};
    for (DoctorCheck& check : checkCaches(caches))
        checks.push_back(std::move(check));
    checks.push_back(checkSpace("temporary files", temporaryFolderOr(fs::temp_directory_path().string())));
    checks.push_back(checkDevice(folder));
    checks.push_back(checkThreads());
    checks.push_back(checkMemory());
    return checks;
}

bool allPassed(const std::vector<DoctorCheck>& checks)
{
    return std::none_of(checks.begin(), checks.end(),
                        [](const DoctorCheck& check) { return check.state == State::wrong; });
}

std::string checksText(const std::vector<DoctorCheck>& checks)
{
    std::string text;
    for (const DoctorCheck& check : checks)
    {
        text += fmt::format("{:<9}{:<9}{}\n", stateName(check.state), check.name, check.text);
        if (!check.remedy.empty())
            text += fmt::format("{:<18}what to do: {}\n", "", check.remedy);
    }
    return text;
}

std::string checksJson(const std::vector<DoctorCheck>& checks)
{
    Json json{{"schema", "hearth.doctor/1"}, {"ok", allPassed(checks)}, {"checks", Json::array()}};
    for (const DoctorCheck& check : checks)
    {
        json["checks"].push_back(
            {{"name", check.name}, {"state", stateName(check.state)}, {"text", check.text}});
        if (!check.remedy.empty())
            json["checks"].back()["remedy"] = check.remedy;
    }
    return json.dump(2) + "\n";
}

} // namespace hearth::command
