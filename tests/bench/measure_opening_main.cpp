// Measures the time to a game's first page: opening a pack with a cold and with a warm file cache, and the
// share of the page check in decoding. `./dev bench runtime` runs it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "formats/base/program.h"
#include "runtime/pack/pack.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fcntl.h>
#include <fstream>
#include <string>
#include <unistd.h>
#include <vector>

namespace
{

using namespace hearth;

constexpr double kMebi = 1 << 20;
constexpr int kWarmRuns = 5;

double measureSeconds(const auto& work)
{
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Bytes that the process has read from disk so far; 0 if the system does not say.
uint64_t bytesFromDisk()
{
    std::ifstream file("/proc/self/io");
    std::string name;
    uint64_t value = 0;
    while (file >> name >> value)
        if (name == "read_bytes:")
            return value;
    return 0;
}

/// Ask the system to drop the file from its page cache. It may refuse if other processes have the file open.
void forget(const std::string& path)
{
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0)
        return;
    ::posix_fadvise(file, 0, 0, POSIX_FADV_DONTNEED);
    ::close(file);
}

Status measureOpening(const std::string& path)
{
    forget(path);
    const uint64_t before = bytesFromDisk();
    Status opened = success();
    const auto open = [&]
    {
        const auto pack = pack::Pack::open(path);
        if (!pack.ok())
            opened = pack.error();
    };
    const double cold = measureSeconds(open);
    HEARTH_TRY(std::move(opened));
    const double read = static_cast<double>(bytesFromDisk() - before);
    double warm = cold;
    for (int i = 0; i < kWarmRuns; ++i)
        warm = std::min(warm, measureSeconds(open));
    std::printf("open, not in memory  %8.3f s, %.1f MiB from the disk\n", cold, read / kMebi);
    std::printf("open, in memory      %8.3f s\n", warm);
    return success();
}

/// Mean microseconds to decode a page, over every `stride`th page.
Result<double> microsecondsOfAPage(const formats::PackView& pack, uint32_t stride)
{
    std::vector<std::byte> buffer(formats::kMaxPageBytes);
    const auto count = static_cast<uint32_t>(pack.pages().size());
    Status status = success();
    const auto readPages = [&]
    {
        for (uint32_t page = 0; page < count && status.ok(); page += stride)
            status = pack.decodePage(page, std::span(buffer).first(pack.pages()[page].size));
    };
    readPages(); // the file is in the page cache afterwards
    double seconds = measureSeconds(readPages);
    for (int i = 1; i < kWarmRuns; ++i)
        seconds = std::min(seconds, measureSeconds(readPages));
    HEARTH_TRY(std::move(status));
    return seconds * 1e6 / ((count + stride - 1) / stride);
}

Status measure(const std::string& path)
{
    HEARTH_TRY(measureOpening(path));
    HEARTH_ASSIGN_OR_RETURN(const pack::Pack pack, pack::Pack::open(path));
    HEARTH_ASSIGN_OR_RETURN(formats::ContainerReader reader,
                            formats::ContainerReader::open(path, formats::Check::structure));
    HEARTH_ASSIGN_OR_RETURN(const formats::PackView unchecked,
                            formats::PackView::read(std::move(reader), formats::PageBytes::left));
    const auto pages = static_cast<uint32_t>(pack->pages().size());
    if (pages > 0)
    {
        const uint32_t stride = pages / 4096 + 1;
        HEARTH_ASSIGN_OR_RETURN(const double decode, microsecondsOfAPage(unchecked, stride));
        HEARTH_ASSIGN_OR_RETURN(const double all, microsecondsOfAPage(pack.view(), stride));
        std::printf("a page               %8.1f us: hash and decode %.1f, check and copy %.1f\n", all, decode,
                    all - decode);
    }
    Status whole = success();
    const double seconds = measureSeconds([&] { whole = pack.checkAll(); });
    HEARTH_TRY(std::move(whole));
    std::printf("check all            %8.3f s: %u pages, %.1f MiB, one core\n", seconds, pages,
                static_cast<double>(pack->container().header().file_size) / kMebi);
    return success();
}

int program(int argc, char** argv)
{
    cli::CommandLine app("Measures opening a pack and checking its pages.", "hearth_measure_opening");
    std::string path;
    app.addOption("PACK", path, "the pack").required();
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    const Status measured = measure(path);
    return measured.ok() ? 0 : reportFailure(measured.error());
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth_measure_opening", [&] { return program(argc, argv); });
}
