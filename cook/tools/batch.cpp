// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/tools/batch.h"

#include "cook/json/json.h"
#include "formats/base/program.h"

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <memory>
#include <optional>
#include <string>
#include <sys/resource.h>
#include <unistd.h>
#include <vector>

#include <tbb/global_control.h>

namespace hearth::tools
{

namespace
{

using Program = std::function<int(int, char**)>;

struct CloseFile
{
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// Redirect stdin or stdout to /dev/null, as for a cooker that runs alone. Return the file that it was
/// before; null on failure.
File redirectToNull(int standard, const char* mode)
{
    const int mine = ::fcntl(standard, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    const int null_device = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    if (mine < 0 || null_device < 0 || ::dup2(null_device, standard) < 0)
        return nullptr;
    ::close(null_device);
    return File(::fdopen(mine, mode));
}

std::optional<std::string> readLine(std::FILE* file)
{
    std::string line;
    for (int c = std::getc(file); c != EOF; c = std::getc(file))
    {
        if (c == '\n')
            return line;
        line += static_cast<char>(c);
    }
    return line.empty() ? std::nullopt : std::optional(line);
}

/// Parse a line that is a JSON array of strings; nullopt if it is none.
std::optional<std::vector<std::string>> parseArguments(const std::string& line)
{
    const Json json = Json::parse(line).value_or(Json());
    if (!json.is_array())
        return std::nullopt;
    std::vector<std::string> words;
    for (const Json& word : json)
    {
        if (!word.is_string())
            return std::nullopt;
        words.push_back(word.get<std::string>());
    }
    return words;
}

double cpuSeconds()
{
    double seconds = 0;
    for (const auto whose : {RUSAGE_SELF, RUSAGE_CHILDREN})
    {
        rusage usage{};
        ::getrusage(whose, &usage);
        for (const timeval& time : {usage.ru_utime, usage.ru_stime})
            seconds += static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
    }
    return seconds;
}

/// Reset the peak of the process's resident memory: Linux does so when 5 is written to this file, see
/// proc(5).
void resetPeak()
{
    if (const File file{std::fopen("/proc/self/clear_refs", "we")})
        std::fputs("5", file.get());
}

uint64_t peakBytes()
{
    const File file{std::fopen("/proc/self/status", "re")};
    char line[256];
    while (file && std::fgets(line, sizeof(line), file.get()) != nullptr)
        if (std::strncmp(line, "VmHWM:", 6) == 0)
            return std::strtoull(line + 6, nullptr, 10) * 1024;
    return 0;
}

Json run(const char* name, std::vector<std::string> words, const Program& program)
{
    words.insert(words.begin(), name);
    std::vector<char*> arguments;
    for (std::string& word : words)
        arguments.push_back(word.data());
    arguments.push_back(nullptr);

    resetPeak();
    const double cpu_before = cpuSeconds();
    const auto start = std::chrono::steady_clock::now();
    const int exit_code =
        runProgram(name, [&] { return program(static_cast<int>(words.size()), arguments.data()); });
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    std::fflush(stdout);
    return {{"exit", exit_code},
            {"seconds", seconds.count()},
            {"cpu_seconds", cpuSeconds() - cpu_before},
            {"peak_rss_bytes", peakBytes()}};
}

int runBatch(const char* name, const Program& program)
{
    // one thread each: callers use a batch if they have more command lines than cores
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const File lines = redirectToNull(STDIN_FILENO, "r");
    const File ends = redirectToNull(STDOUT_FILENO, "w");
    const auto fail = [&](const Error& error)
    {
        std::fprintf(stderr, "%s\n", formatMessage(error).c_str());
        return exitCode(error);
    };
    if (!lines || !ends)
        return fail({Issue::internal, name, "", std::string("no batch can be run: ") + std::strerror(errno)});
    for (size_t number = 1;; ++number)
    {
        const std::optional<std::string> line = readLine(lines.get());
        if (!line)
            return 0;
        std::optional<std::vector<std::string>> words = parseArguments(*line);
        if (!words)
            return fail({Issue::usage, name, "line " + std::to_string(number),
                         "--batch reads lines that are each a JSON array of words"});
        const std::string end = run(name, std::move(*words), program).dump();
        std::fprintf(ends.get(), "%c%s\n", kRecordSeparator, end.c_str());
        std::fflush(ends.get());
    }
}

} // namespace

int runCooker(const char* name, int argc, char** argv, const Program& program)
{
    const std::string only_word = argc == 2 ? argv[1] : "";
    if (only_word == "--batch")
        return runProgram(name, [&] { return runBatch(name, program); });
    const int exit_code = runProgram(name, [&] { return program(argc, argv); });
    if (only_word == "-h" || only_word == "--help")
        std::printf("%s --batch runs many command lines: each line of stdin, a JSON array of words.\n", name);
    return exit_code;
}

} // namespace hearth::tools
