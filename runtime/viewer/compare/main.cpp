// hearth-compare: compares two images, as numbers and as a heat map.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/program.h"
#include "runtime/viewer/command_line.h"
#include "runtime/viewer/compare/flip.h"
#include "runtime/viewer/file_output.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace hearth::viewer
{

namespace
{

struct CompareOptions
{
    std::string a;
    std::string b;
    std::string heat_map;
    std::string stats;
    bool help = false;
};

std::string compareHelp()
{
    return "Usage: hearth-compare A.png --with B.png [options]\n"
           "Say how two images of one size differ, as JSON (schema hearth.compare/1).\n"
           "\n"
           "  -o, --output FILE  a heat map, PNG: black where they are the same\n"
           "      --stats FILE   write the JSON there, not to stdout\n"
           "  -h, --help         this text\n";
}

Result<CompareOptions> parseCompareOptions(std::span<const char* const> arguments)
{
    CompareOptions options;
    CommandLine line;
    line.addText("--with", options.b);
    line.addText("-o", options.heat_map);
    line.addText("--output", options.heat_map);
    line.addText("--stats", options.stats);
    line.addSwitch("-h", options.help);
    line.addSwitch("--help", options.help);
    HEARTH_TRY(line.parse(arguments, options.a));
    if (!options.help && (options.a.empty() || options.b.empty()))
        return usageError("needs two images: A.png --with B.png");
    return options;
}

/// Differences over all channels, in units of 1/255.
struct Difference
{
    double rms = 0;
    int largest = 0;
    uint64_t pixels = 0; ///< pixels that differ
};

Difference computeDifference(const Image& a, const Image& b)
{
    Difference difference;
    double sum = 0;
    for (size_t pixel = 0; pixel < a.rgb.size(); pixel += 3)
    {
        int largest = 0;
        for (size_t channel = pixel; channel < pixel + 3; ++channel)
        {
            const int step = std::abs(int{a.rgb[channel]} - int{b.rgb[channel]});
            sum += double(step) * double(step);
            largest = std::max(largest, step);
        }
        difference.pixels += largest > 0 ? 1 : 0;
        difference.largest = std::max(difference.largest, largest);
    }
    difference.rms = std::sqrt(sum / static_cast<double>(a.rgb.size()));
    return difference;
}

/// Return the error that this many of a thousand pixels do not exceed.
double quantile(std::vector<float> errors, size_t of_thousand)
{
    const size_t index = (errors.size() - 1) * of_thousand / 1000;
    std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(index), errors.end());
    return double{errors[index]};
}

std::string statsJson(const FlipMap& map, const Difference& difference)
{
    char text[512];
    const int size =
        std::snprintf(text, sizeof(text),
                      "{\"schema\": \"hearth.compare/1\", \"width\": %u, \"height\": %u,\n"
                      " \"flip\": {\"mean\": %.6g, \"percentile_99\": %.6g, \"percentile_99.9\": %.6g},\n"
                      " \"rms\": %.6g, \"largest_step\": %d, \"different_pixels\": %llu}\n",
                      map.width, map.height, map.mean(), quantile(map.error, 990), quantile(map.error, 999),
                      difference.rms, difference.largest, static_cast<unsigned long long>(difference.pixels));
    return {text, static_cast<size_t>(size)};
}

Status writeHeatMap(const std::string& path, const FlipMap& map)
{
    const Image image = makeFlipImage(map);
    std::vector<std::byte> rgba;
    for (size_t i = 0; i < image.rgb.size(); ++i)
    {
        rgba.push_back(std::byte{image.rgb[i]});
        if (i % 3 == 2)
            rgba.push_back(std::byte{255});
    }
    HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> png, encodePng(rgba, image.width, image.height));
    return writeFile(path, png);
}

Status compare(const CompareOptions& options)
{
    HEARTH_ASSIGN_OR_RETURN(const Image a, readPng(options.a));
    HEARTH_ASSIGN_OR_RETURN(const Image b, readPng(options.b));
    if (a.width != b.width || a.height != b.height)
        return usageError("the images have different sizes");
    const FlipMap map = flip(a, b);
    if (!options.heat_map.empty())
        HEARTH_TRY(writeHeatMap(options.heat_map, map));
    const std::string stats = statsJson(map, computeDifference(a, b));
    if (!options.stats.empty())
        return writeFile(options.stats, std::as_bytes(std::span(stats)));
    if (std::fputs(stats.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
        return Error{Issue::read_failed, "stdout", "", "cannot be written"};
    return success();
}

int runCompare(std::span<const char* const> arguments)
{
    return runCommand(parseCompareOptions(arguments), compareHelp(), compare);
}

} // namespace

} // namespace hearth::viewer

int main(int argc, char** argv)
{
    return hearth::runProgram(
        "hearth-compare",
        [&] {
            return hearth::viewer::runCompare({argv + 1, static_cast<size_t>(argc > 0 ? argc - 1 : 0)});
        });
}
