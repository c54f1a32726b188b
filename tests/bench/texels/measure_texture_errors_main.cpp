// hearth_measure_texture_errors: compares the errors that encoded textures store with a plain recount, and
// the targets that they store with the documented ones. A texture may miss its target only with a warning.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/texels/texel_source.h"
#include "cook/tools/child_processes.h"
#include "formats/base/program.h"
#include "formats/pack/image_error.h"
#include "tests/bench/aims.h"
#include "tests/bench/texels/recount.h"
#include "tests/support/sandbox.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <sstream>

namespace
{

using namespace hearth;
using namespace hearth::formats;
namespace fs = std::filesystem;

struct Figures
{
    uint32_t sources = 0, refused = 0, images = 0, warnings = 0;
    double cutout_difference = 0; ///< of all errors, as the next one
    double difference = 0;
    double percentile_below = 0; ///< how far error_p999 is below the recounted one: as share of the range
    double percentile_above = 0;
    double coverage_difference = 0;
    uint32_t silent_misses = 0, wrong_warnings = 0;
    uint32_t other_targets = 0; ///< that are not the documented ones
};

/// Largest error that matters of a texel, in the unit of the role.
double findRange(ImageRole role)
{
    return role == ImageRole::light ? 16 : role == ImageRole::normal ? 2 : 1;
}

/// True if the stored targets are those of normal quality. Source: docs/textures.md, cook/texels/README.md.
bool hasDocumentedTargets(ImageRole role, const ImageRecord& stored)
{
    const auto isNear = [](float target, double documented)
    { return std::abs(double{target} - documented) <= 1e-6 * documented; };
    const auto share = [](double decibels) { return std::pow(10, -decibels / 20); };
    const bool is_small = std::max(stored.width, stored.height) <= 256;
    const double usual_normal = 1.5 * std::acos(-1.0) / 180;
    switch (role)
    {
    case ImageRole::normal: // by how bumpy it is
        return stored.target_smooth == 0 && double{stored.target} >= usual_normal * (0.5 - 1e-6) &&
               double{stored.target} <= usual_normal * (1 + 1e-6);
    case ImageRole::light:
        return stored.target_smooth == 0 && isNear(stored.target, 0.05);
    case ImageRole::data:
        return stored.target_smooth == 0 && isNear(stored.target, share(36));
    default:
        return isNear(stored.target_smooth, share(53)) &&
               isNear(stored.target, share(role == ImageRole::cutout ? 45
                                           : is_small                ? 42
                                                                     : 39));
    }
}

/// Part of a target that an error takes; 0 where there is no target.
double findShare(double error, float target)
{
    return target == 0 ? 0 : error / double{target};
}

/// Compare one image.
void measureImage(const texels::PlainImage& plain, const ImageRecord& stored, std::span<const std::byte> mips,
                  bool is_warned, const std::string& name, Figures& figures)
{
    const bench::Recount recount = bench::recountErrors(plain, stored, mips);
    const double difference = std::max(std::abs(recount.error - double{stored.error}),
                                       std::abs(recount.smooth - double{stored.error_smooth}));
    double& largest = plain.role == ImageRole::cutout ? figures.cutout_difference : figures.difference;
    largest = std::max(largest, difference);
    const double above = (double{stored.error_p999} - recount.p999) / findRange(plain.role);
    figures.percentile_above = std::max(figures.percentile_above, above);
    figures.percentile_below = std::max(figures.percentile_below, -above);
    figures.coverage_difference =
        std::max(figures.coverage_difference, std::abs(recount.coverage - double{stored.coverage_error}));

    const double share =
        std::max(findShare(recount.error, stored.target), findShare(recount.smooth, stored.target_smooth));
    const bool misses = share > 1 + 1e-4, holds = share < 1 - 1e-4;
    const bool has_targets = hasDocumentedTargets(plain.role, stored);
    figures.other_targets += !has_targets;
    figures.silent_misses += misses && !is_warned;
    figures.wrong_warnings += holds && is_warned;
    figures.warnings += is_warned;
    ++figures.images;
    if (difference > 1e-5 || std::abs(above) > 1e-3 || (misses && !is_warned) || (holds && is_warned) ||
        !has_targets)
        fmt::print("{}: {}, stored {} and {}, recounted {} and {}, targets {} and {}, 99.9 % {} and {}{}\n",
                   name, imageRoleName(static_cast<uint32_t>(plain.role)), stored.error, stored.error_smooth,
                   recount.error, recount.smooth, stored.target, stored.target_smooth, stored.error_p999,
                   recount.p999, is_warned ? ", warned of" : "");
}

/// Run a cooker in the folder. Return false if it refuses; add its messages.
bool run(test::Sandbox& folder, std::vector<std::string> words, std::string& messages)
{
    words.front() = tools::programFolder() + "/" + words.front();
    const test::ProgramEnd end = folder.run(words);
    messages = end.err;
    if (end.exit_code != 0 && end.exit_code != 65 && end.exit_code != 66)
        fmt::print("{}: exit code {}: {}\n", words.front(), end.exit_code, end.err);
    return end.exit_code == 0;
}

/// True if messages have a warning of the target of an image.
bool isWarned(const std::string& messages, const std::string& place)
{
    std::istringstream lines(messages);
    for (std::string line; std::getline(lines, line);)
        if (line.find("|" + place + ": warning: ") != std::string::npos &&
            line.find("[W1309]") != std::string::npos)
            return true;
    return false;
}

Status measureSource(const std::string& source, const std::vector<std::string>& options, Figures& figures)
{
    test::Sandbox folder;
    std::string messages;
    ++figures.sources;
    std::vector<std::string> encode{"hearth-texels", "import.part", "textures.part", "-o", "texels.part"};
    encode.insert(encode.end(), options.begin(), options.end());
    if (!run(folder, {"hearth-import", source, "-o", "import.part"}, messages) ||
        !run(folder, {"hearth-textures", "import.part", "-o", "textures.part"}, messages) ||
        !run(folder, encode, messages))
    {
        ++figures.refused;
        return success();
    }
    HEARTH_ASSIGN_OR_RETURN(const texels::TexelSource plain,
                            texels::TexelSource::open(folder / "import.part", folder / "textures.part"));
    HEARTH_ASSIGN_OR_RETURN(ContainerReader reader,
                            ContainerReader::open(folder / "texels.part", Check::structure));
    HEARTH_ASSIGN_OR_RETURN(const PackView stored, PackView::read(std::move(reader)));
    for (uint32_t i = 0; i < stored.images().size(); ++i)
    {
        HEARTH_ASSIGN_OR_RETURN(const texels::LoadedImage loaded, plain.load(i));
        HEARTH_ASSIGN_OR_RETURN(const ChunkData data, stored.imageData(i));
        const std::string place = "image " + std::to_string(i) + " \"" + loaded.name + "\"";
        measureImage(loaded.image, stored.images()[i], data.bytes(), isWarned(messages, place),
                     source + ", " + place, figures);
    }
    return success();
}

int judge(const Figures& figures)
{
    fmt::print("{} sources, {} of them refused; {} images, {} of them with a warning of their target\n",
               figures.sources, figures.refused, figures.images, figures.warnings);
    bench::Judgement judgement("texture-errors");
    judgement.record("stored error off its recount", figures.difference);
    judgement.record("stored error off its recount, cut-outs", figures.cutout_difference);
    judgement.record("error_p999 below its recount, of the range", figures.percentile_below);
    judgement.record("error_p999 above its recount, of the range", figures.percentile_above);
    judgement.record("stored coverage off its recount", figures.coverage_difference);
    judgement.record("targets other than documented", figures.other_targets);
    judgement.record("targets missed without a warning", figures.silent_misses);
    judgement.record("warnings of targets that are held", figures.wrong_warnings);
    return judgement.finish();
}

int program(int argc, char** argv)
{
    cli::CommandLine app(
        "Encodes the textures of models for phones and recounts the errors that they store.");
    std::vector<std::string> sources, families;
    std::string jobs = "0";
    app.addOption("source", sources, "models").required();
    app.addOption("--family", families, "as that of hearth-texels; default: astc and etc2");
    app.addOption("-j,--jobs", jobs, "threads of the encoder");
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    std::vector<std::string> options{"--jobs", jobs};
    for (const std::string& family : families)
        options.insert(options.end(), {"--family", family});
    Figures figures;
    for (const std::string& source : sources)
    {
        if (const Status measured = measureSource(fs::absolute(source).string(), options, figures);
            !measured.ok())
            return reportFailure(measured.error());
        fmt::print("{}: {} images so far, stored errors off by at most {:.1e}, of cut-outs {:.1e}\n", source,
                   figures.images, figures.difference, figures.cutout_difference);
        std::fflush(stdout); // it takes long
    }
    return judge(figures);
}

} // namespace

int main(int argc, char** argv)
{
    return runProgram("hearth_measure_texture_errors", [&] { return program(argc, argv); });
}
