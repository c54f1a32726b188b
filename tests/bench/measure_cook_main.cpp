// Measures a cook without cache, on one core and on all: seconds, CPU seconds and peak memory of each stage
// and of all processes together. `./dev bench cook` runs it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "cook/tools/child_processes.h"
#include "formats/base/program.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <spawn.h>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace
{

using namespace hearth;

constexpr auto kPollEvery = std::chrono::milliseconds(20);
constexpr double kMiB = 1 << 20;

/// A process and all its descendants, on Linux.
std::vector<pid_t> findFamily(pid_t process)
{
    std::vector<pid_t> family{process};
    std::error_code error;
    const std::string tasks = "/proc/" + std::to_string(process) + "/task";
    for (auto task = std::filesystem::directory_iterator(tasks, error);
         !error && task != std::filesystem::directory_iterator(); task.increment(error))
    {
        std::ifstream children(task->path() / "children");
        for (pid_t child = 0; children >> child;)
        {
            const std::vector<pid_t> more = findFamily(child);
            family.insert(family.end(), more.begin(), more.end());
        }
    }
    return family;
}

/// Memory of the processes together. Shared pages count once (sum of PSS, proc(5)).
uint64_t measureMemory(const std::vector<pid_t>& processes)
{
    uint64_t kilobytes = 0;
    for (const pid_t process : processes)
    {
        std::ifstream file("/proc/" + std::to_string(process) + "/smaps_rollup");
        for (std::string line; std::getline(file, line);)
            if (line.starts_with("Pss:"))
                kilobytes += std::stoull(line.substr(4));
    }
    return kilobytes * 1024;
}

struct Cook
{
    Json report;
    uint64_t peak_bytes = 0; ///< all processes together, sampled periodically
};

/// on_one_core  pin to one core; else use all
std::optional<Cook> cook(const std::string& source, const std::string& output, bool on_one_core)
{
    const std::string report = output + ".json";
    std::vector<std::string> words;
    if (on_one_core)
        words = {"/usr/bin/taskset", "--cpu-list", "0"}; // the children inherit the CPU list
    const std::vector<std::string> cooking{tools::programFolder() + "/hearth",
                                           "cook",
                                           "-q",
                                           "--no-cache",
                                           "-j",
                                           on_one_core ? "1" : "2",
                                           "--report",
                                           report,
                                           source,
                                           "-o",
                                           output};
    words.insert(words.end(), cooking.begin(), cooking.end());
    std::vector<char*> arguments;
    for (std::string& word : words)
        arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_t process = 0;
    if (::posix_spawn(&process, arguments[0], nullptr, nullptr, arguments.data(), environ) != 0)
        return std::nullopt;
    Cook result;
    int status = 0;
    while (::waitpid(process, &status, WNOHANG) == 0)
    {
        result.peak_bytes = std::max(result.peak_bytes, measureMemory(findFamily(process)));
        std::this_thread::sleep_for(kPollEvery);
    }
    if (status != 0)
        return std::nullopt;
    std::ifstream file(report);
    const std::string text(std::istreambuf_iterator<char>(file), {});
    result.report = Json::parse(text).value_or(Json());
    return result;
}

void print(unsigned cores, const Cook& cook)
{
    const auto row = [&](const std::string& stage, double seconds, double cpu, double bytes)
    {
        std::printf("| %5u | %-10s | %8.1f | %8.1f | %8.0f |\n", cores, stage.c_str(), seconds, cpu,
                    bytes / kMiB);
    };
    const auto rows = [&](const Json& stages)
    {
        for (const auto& stage : stages)
            row(stage["stage"].get<std::string>(), stage["seconds"].get<double>(),
                stage["cpu_seconds"].get<double>(), stage["peak_rss_bytes"].get<double>());
    };
    rows(cook.report["assets"][0]["stages"]);
    rows(Json::array({cook.report["link"]}));
    const auto& totals = cook.report["totals"];
    row("all", totals["wall_s"].get<double>(), totals["cpu_s"].get<double>(),
        static_cast<double>(cook.peak_bytes));
}

uint64_t sumTriangles(const Cook& cook)
{
    uint64_t triangles = 0;
    for (const auto& mesh : cook.report["assets"][0]["clusters"]["meshes"])
        triangles += mesh["source"]["triangles"].get<uint64_t>();
    return triangles;
}

int measure(const std::string& source, const std::string& output)
{
    const unsigned cores = std::thread::hardware_concurrency();
    const std::optional<Cook> slow = cook(source, output, true);
    const std::optional<Cook> fast = slow ? cook(source, output, false) : std::nullopt;
    if (!fast)
        return 1; // hearth has printed the reason
    std::printf("| cores | stage      |  seconds |  CPU     | MiB peak |\n|---|---|---|---|---|\n");
    print(1, *slow);
    print(cores, *fast);
    const auto seconds = [](const Cook& cook) { return cook.report["totals"]["wall_s"].get<double>(); };
    const auto triangles = static_cast<double>(sumTriangles(*fast));
    std::printf(
        "%.1f million triangles; %.1f bytes of memory and %.2f of pack a triangle; %u cores are %.2f times "
        "as fast as one\n",
        triangles * 1e-6, static_cast<double>(fast->peak_bytes) / triangles,
        fast->report["totals"]["bytes_out"].get<double>() / triangles, cores,
        seconds(*slow) / seconds(*fast));
    return 0;
}

} // namespace

int main(int argc, char** argv)
{
    if (argc != 3)
    {
        std::fprintf(stderr, "usage: hearth_measure_cook SOURCE PACK\n");
        return 2;
    }
    return runProgram("hearth_measure_cook", [&] { return measure(argv[1], argv[2]); });
}
