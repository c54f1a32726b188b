// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/roundtrip/cooked_sample.h"

#include "tests/corpus/run_process.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace hearth::roundtrip
{

namespace
{

const char* getPath(Program program)
{
    switch (program)
    {
    case Program::samples:
        return HEARTH_SAMPLES_PROGRAM;
    case Program::import:
        return HEARTH_IMPORT_PROGRAM;
    case Program::clusters:
        return HEARTH_CLUSTERS_PROGRAM;
    case Program::textures:
        return HEARTH_TEXTURES_PROGRAM;
    case Program::skinning:
        return HEARTH_SKINNING_PROGRAM;
    case Program::link:
        return HEARTH_LINK_PROGRAM;
    case Program::hearth:
        return HEARTH_PROGRAM;
    case Program::render:
        return HEARTH_RENDER_PROGRAM;
    }
    return "";
}

std::string readText(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

/// Run a step that must succeed.
void mustRun(Program program, const std::vector<std::string>& arguments)
{
    const ProgramEnd end = runProgram(program, arguments);
    if (end.exit_code == 0)
        return;
    std::fprintf(stderr, "%s ended with %d: %s\n", getPath(program), end.exit_code, end.errors.c_str());
    std::abort();
}

template <typename T>
T must(Result<T> result)
{
    if (!result.ok())
    {
        std::fprintf(stderr, "%s\n", formatMessage(result.error()).c_str());
        std::abort();
    }
    return std::move(result).value();
}

/// Lock that one process at a time holds.
class FileLock
{
public:
    explicit FileLock(const std::string& path) : file_(open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666))
    {
        if (file_ < 0 || flock(file_, LOCK_EX) != 0)
            std::abort();
    }
    ~FileLock() { close(file_); }
    FileLock(const FileLock&) = delete;

private:
    int file_;
};

/// Sizes and times of the programs that make a sample: changes with each build of any of them.
std::string stampOfPrograms()
{
    std::string stamp;
    for (const Program program : {Program::samples, Program::import, Program::clusters, Program::textures,
                                  Program::skinning, Program::link})
    {
        const std::filesystem::path path = getPath(program);
        stamp += path.string() + " " + std::to_string(std::filesystem::file_size(path)) + " " +
                 std::to_string(std::filesystem::last_write_time(path).time_since_epoch().count()) + "\n";
    }
    return stamp;
}

/// Make source, parts and pack of a sample in a folder.
void cookSample(const SampleSpec& spec, const std::filesystem::path& folder)
{
    const std::string source = folder / "sample.glb", part = folder / "import.part";
    const std::string clusters = folder / "clusters.part", textures = folder / "textures.part";
    const std::string skinning = folder / "skinning.part";
    std::vector<std::string> arguments{spec.kind, "-o", source, "--texture-size",
                                       std::to_string(spec.texture_size)};
    if (spec.triangles > 0)
        arguments.insert(arguments.end(), {"--triangles", std::to_string(spec.triangles)});
    mustRun(Program::samples, arguments);
    mustRun(Program::import, {source, "-o", part});
    mustRun(Program::clusters, {part, "-o", clusters});
    mustRun(Program::textures, {part, "-o", textures});
    mustRun(Program::skinning, {part, clusters, "-o", skinning});
    mustRun(Program::link, {part, clusters, textures, skinning, "-o", folder / "sample.hearth"});
}

} // namespace

ProgramEnd runProgram(Program program, const std::vector<std::string>& arguments)
{
    return runProgram(getPath(program), arguments);
}

ProgramEnd runProgram(const std::string& program, const std::vector<std::string>& arguments)
{
    const ScratchFolder folder;
    corpus::Command command;
    command.arguments = {program};
    command.arguments.insert(command.arguments.end(), arguments.begin(), arguments.end());
    command.folder = folder.path("");
    command.stdout_file = folder.path("stdout");
    command.stderr_file = folder.path("stderr");
    // generous: a hang must end the test, but a slow machine must not
    const corpus::ProcessEnd end =
        corpus::runProcess(command, {.seconds = 300, .rss_bytes = uint64_t{8} << 30});
    const bool by_itself = end.started && end.signal == 0 && !end.over_time && !end.over_memory;
    return {by_itself ? end.exit_code : -1, readText(command.stdout_file), readText(command.stderr_file)};
}

ScratchFolder::ScratchFolder()
{
    std::string name = (std::filesystem::temp_directory_path() / "hearth-roundtrip-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
        std::abort();
    folder_ = name;
}

ScratchFolder::~ScratchFolder()
{
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

CookedSample::CookedSample(const SampleSpec& spec)
{
    const std::filesystem::path folder =
        std::filesystem::path(HEARTH_SHARED_SAMPLES) /
        (spec.kind + "-" + std::to_string(spec.triangles) + "-" + std::to_string(spec.texture_size));
    std::filesystem::create_directories(folder);
    {
        const FileLock lock(folder / "lock");
        const std::string made_by = stampOfPrograms();
        if (readText(folder / "made-by") != made_by)
        {
            cookSample(spec, folder);
            std::ofstream(folder / "made-by") << made_by;
        }
    }
    pack_path_ = folder / "sample.hearth";
    pack_ = std::make_unique<pack::Pack>(must(pack::Pack::open(pack_path_)));
    geometry_ =
        std::make_unique<reference::PackGeometry>(must(reference::PackGeometry::decode(pack_->view())));
    import_part_ = std::make_unique<formats::PackView>(
        must(formats::PackView::read(must(formats::ContainerReader::open(folder / "import.part")))));
}

const CookedSample& cookedSample(const SampleSpec& spec)
{
    static std::map<std::tuple<std::string, uint64_t, uint32_t>, std::unique_ptr<CookedSample>> samples;
    std::unique_ptr<CookedSample>& sample = samples[{spec.kind, spec.triangles, spec.texture_size}];
    if (!sample)
        sample = std::make_unique<CookedSample>(spec);
    return *sample;
}

} // namespace hearth::roundtrip
