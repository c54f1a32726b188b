// hearth_measure_textures: compression of real textures by measured error, beside one footprint for all.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/texels/role.h"
#include "cook/texels/search/search.h"
#include "cook/tools/child_processes.h"
#include "formats/base/program.h"
#include "formats/pack/image_error.h"
#include "formats/pack/part_materials.h"
#include "tests/bench/aims.h"
#include "tests/support/sandbox.h"

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <sys/resource.h>

namespace
{

using namespace hearth;
using namespace hearth::formats;
using namespace hearth::texels;

double processorSeconds()
{
    timespec now{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Sums over the images of a role.
struct RoleSums
{
    uint32_t images = 0, missed = 0;
    uint64_t plain_bytes = 0, bytes = 0, fixed_bytes = 0;
    double worst = 0, fixed_worst = 0;
    double mean = 0, fixed_mean = 0; ///< squares
};

/// Processor time of images of one size.
struct Times
{
    uint32_t images = 0;
    double encode = 0;
    double search = 0;
};

/// Finds the largest footprint in which each image holds its targets, as far as Hearth's format does: one
/// footprint for all would have to be that small.
struct CommonFootprint
{
    std::vector<TexelFormat> formats{}; ///< linear ones, from 6x6 to finer ones
    size_t chosen = 0;
    std::vector<ImageRecord> images{};

    /// Return the bytes of all images in the footprint.
    uint64_t countBytes() const;
};

struct Measured
{
    CommonFootprint common{{astcFormat(TexelFormat::astc_unorm, 4), astcFormat(TexelFormat::astc_unorm, 3),
                            astcFormat(TexelFormat::astc_unorm, 2), astcFormat(TexelFormat::astc_unorm, 1),
                            astcFormat(TexelFormat::astc_unorm, 0)}}; ///< of colours and data
    std::map<std::string_view, RoleSums> roles;
    std::map<uint32_t, Times> times; ///< [side]: of colours with 1024 and 2048 texels a side
};

Result<PackView> openPart(const std::string& path)
{
    HEARTH_ASSIGN_OR_RETURN(ContainerReader reader, ContainerReader::open(path, Check::structure));
    return PackView::read(std::move(reader));
}

uint64_t CommonFootprint::countBytes() const
{
    const TexelFormatTraits& traits = texelTraits(formats[chosen]);
    uint64_t bytes = 0;
    for (const ImageRecord& image : images)
        for (uint32_t mip = 0; mip < image.mip_count; ++mip)
            bytes += formats::mipBytes(traits, mipExtent(image, mip).width, mipExtent(image, mip).height);
    return bytes;
}

/// Refine the common footprint until an image holds its target, or as much of it as was found to be possible.
void addToCommon(const PlainImage& image, std::span<const Candidate> candidates, const Target& target,
                 double share, Effort quality, CommonFootprint& common)
{
    common.images.push_back(image.record);
    const std::vector<SmoothCells> smooth = findSmoothCells(image);
    for (; common.chosen + 1 < common.formats.size(); ++common.chosen)
    {
        const TexelFormatTraits& traits = texelTraits(common.formats[common.chosen]);
        const auto candidate = std::ranges::find_if(candidates,
                                                    [&](const Candidate& c)
                                                    {
                                                        return c.traits->family == TexelFamily::astc &&
                                                               c.traits->block_width == traits.block_width &&
                                                               c.traits->block_height == traits.block_height;
                                                    });
        const ImageError error =
            measureError(image, smooth, *candidate, encodeImage(image, smooth, *candidate, quality));
        if (std::max(error.error / target.error, error.smooth / target.smooth) <= std::max(1.0, share))
            return;
    }
}

/// Return the fixed footprint that a role is compared with: 6x6, of normals 4x4.
const Candidate& findFixed(std::span<const Candidate> candidates, ImageRole role)
{
    const uint32_t side = role == ImageRole::normal ? 4 : 6;
    return *std::ranges::find_if(candidates,
                                 [&](const Candidate& candidate)
                                 {
                                     const TexelFormatTraits& traits = *candidate.traits;
                                     return traits.family == TexelFamily::astc &&
                                            traits.block_width == side && traits.block_height == side;
                                 });
}

void measureImage(const PlainImage& image, const std::string& name, Effort quality, Measured& result)
{
    const Families families{.astc = true, .etc2 = true};
    const std::vector<Candidate> candidates = listCandidates(image, families);
    const Target target = findTarget(image, quality);
    const double start = processorSeconds();
    const Encoding found = encodeForTarget(image, candidates, target, quality, false);
    const double searched = processorSeconds() - start;
    const double again = processorSeconds();
    const std::vector<SmoothCells> smooth = findSmoothCells(image); // the encoder searches longer there
    (void)encodeImage(image, smooth, found.candidate, quality);
    const double encoded = processorSeconds() - again;
    const Candidate& fixed = findFixed(candidates, image.role);
    const std::vector<std::byte> fixed_texels = encodeImage(image, {}, fixed, quality);
    const ImageError fixed_error = measureError(image, {}, fixed, fixed_texels);
    if (image.role != ImageRole::normal)
        addToCommon(image, candidates, target, found.share, quality, result.common);

    fmt::print(
        "{:40.40} {:>5} x {:<5} {:9} {:16} {:>9} bytes {:>13}, smooth {:>13}{}; fixed {:>9} {:>13}; "
        "encoding {:.2f} s, search {:.2f} s\n",
        name, image.record.width, image.record.height, imageRoleName(static_cast<uint32_t>(image.role)),
        found.candidate.traits->name, found.texels.size(), imageErrorText(image.role, found.error.error),
        imageErrorText(image.role, found.error.smooth), found.share > 1 ? " MISSED" : "", fixed_texels.size(),
        imageErrorText(image.role, fixed_error.error), encoded, searched - encoded);
    RoleSums& sums = result.roles[imageRoleName(static_cast<uint32_t>(image.role))];
    ++sums.images;
    sums.missed += found.share > 1;
    sums.plain_bytes += image.mips.size();
    sums.bytes += found.texels.size();
    sums.fixed_bytes += fixed_texels.size();
    sums.worst = std::max(sums.worst, found.error.error);
    sums.fixed_worst = std::max(sums.fixed_worst, fixed_error.error);
    sums.mean += found.error.error * found.error.error;
    sums.fixed_mean += fixed_error.error * fixed_error.error;
    const uint32_t side = std::max(image.record.width, image.record.height);
    if (image.role == ImageRole::color && image.record.width == image.record.height &&
        (side == 1024 || side == 2048))
    {
        Times& times = result.times[side];
        ++times.images;
        times.encode += encoded;
        times.search += searched - encoded;
    }
}

Status measureSource(const std::string& stem, Effort quality, uint32_t max_images, Measured& result)
{
    HEARTH_ASSIGN_OR_RETURN(const PackView import_part, openPart(stem + ".import.part"));
    HEARTH_ASSIGN_OR_RETURN(const PackView textures, openPart(stem + ".textures.part"));
    const std::span<const MaterialRecord> materials = findMaterials(import_part, textures);
    const auto uses =
        imageUses(materials, findMaterialLayers(import_part, textures), textures.images().size());
    for (uint32_t i = 0; i < std::min<size_t>(textures.images().size(), max_images); ++i)
    {
        HEARTH_ASSIGN_OR_RETURN(const ChunkData data, textures.imageData(i));
        PlainImage image{.record = textures.images()[i], .mips = data.bytes()};
        const ImageReads reads = findReads(image.record, uses[i], materials);
        image.role = reads.role;
        image.channels = reads.channels;
        if (image.role != ImageRole::light && std::min(image.record.width, image.record.height) >= 128 &&
            (image.record.flags & kImagePlaceholder) == 0)
            measureImage(image,
                         stem.substr(stem.rfind('/') + 1) + " " +
                             std::string(import_part.text(image.record.name)),
                         quality, result);
    }
    return success();
}

void printRoles(const Measured& result)
{
    fmt::print("\n{:10} {:>6} {:>6} {:>12} {:>12} {:>12} {:>6} {:>13} {:>13}\n", "role", "images", "missed",
               "plain", "bytes", "fixed", "ratio", "worst", "fixed worst");
    for (const auto& [name, sums] : result.roles)
    {
        const ImageRole role = name == "normal" ? ImageRole::normal : ImageRole::color;
        fmt::print("{:10} {:>6} {:>6} {:>12} {:>12} {:>12} {:>6.2f} {:>13} {:>13}\n", name, sums.images,
                   sums.missed, sums.plain_bytes, sums.bytes, sums.fixed_bytes,
                   static_cast<double>(sums.bytes) / static_cast<double>(sums.fixed_bytes),
                   imageErrorText(role, sums.worst), imageErrorText(role, sums.fixed_worst));
    }
}

/// Return the processor time of all child processes that have ended, in seconds.
double countChildSeconds()
{
    rusage used{};
    ::getrusage(RUSAGE_CHILDREN, &used);
    const auto seconds = [](const timeval& time)
    { return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec); };
    return seconds(used.ru_utime) + seconds(used.ru_stime);
}

/// Return the processor time that hearth-texels takes for drafts of a source's textures, in seconds.
double measureDraft(const std::string& stem)
{
    const std::string parts = std::filesystem::absolute(stem).string();
    const double before = countChildSeconds();
    test::Sandbox folder;
    const test::ProgramEnd end =
        folder.run({tools::programFolder() + "/hearth-texels", parts + ".import.part",
                    parts + ".textures.part", "-o", "texels.part", "--quality", "draft"});
    const double seconds = countChildSeconds() - before;
    fmt::print("draft of {}: {:.2f} s of processor{}\n", stem.substr(stem.rfind('/') + 1), seconds,
               end.exit_code == 0 ? "" : ", failed: " + end.err);
    return end.exit_code == 0 ? seconds : std::numeric_limits<double>::quiet_NaN();
}

int judge(const Measured& result, const std::string& draft_stem)
{
    bench::Judgement judgement("textures");
    if (draft_stem.empty())
        judgement.leaveOut("draft of the demo, s of processor");
    else
        judgement.record("draft of the demo, s of processor", measureDraft(draft_stem));
    RoleSums others, normals;
    for (const auto& [name, sums] : result.roles)
    {
        RoleSums& sum = name == "normal" ? normals : others;
        sum.images += sums.images;
        sum.bytes += sums.bytes;
        sum.fixed_bytes += sums.fixed_bytes;
        sum.worst = std::max(sum.worst, sums.worst);
        sum.fixed_worst = std::max(sum.fixed_worst, sums.fixed_worst);
    }
    const auto ratio = [](uint64_t a, uint64_t b) { return static_cast<double>(a) / static_cast<double>(b); };
    const TexelFormatTraits& common = texelTraits(result.common.formats[result.common.chosen]);
    fmt::print("one footprint that holds all targets: {}x{}, {} bytes\n", common.block_width,
               common.block_height, result.common.countBytes());
    judgement.record("bytes / those of 6x6, colours and data", ratio(others.bytes, others.fixed_bytes));
    judgement.record("bytes / those of one footprint that holds the targets, colours and data",
                     ratio(others.bytes, result.common.countBytes()));
    judgement.record("worst error / that of 6x6, colours and data", others.worst / others.fixed_worst);
    judgement.record("bytes / those of 4x4, normals", ratio(normals.bytes, normals.fixed_bytes));
    judgement.record("worst error / that of 4x4, normals", normals.worst / normals.fixed_worst);
    for (const auto& [side, figure] :
         {std::pair(1024u, "search / one encoding, 1024"), std::pair(2048u, "search / one encoding, 2048")})
        if (const auto found = result.times.find(side); found != result.times.end())
            judgement.record(figure, found->second.search / found->second.encode);
    return judgement.finish();
}

int program(int argc, char** argv)
{
    cli::CommandLine app(
        "Compresses textures by their measured error, beside ASTC 6x6 (normals 4x4) for all.");
    std::vector<std::string> stems;
    std::string quality = "normal";
    std::string draft;
    uint32_t max_images = 1000;
    app.addOption("source", stems, "STEM of STEM.import.part and STEM.textures.part").required();
    app.addOption("--quality", quality, "draft, normal or high");
    app.addOption("--draft", draft,
                  "STEM of the source whose textures are encoded as drafts, for the processor time");
    app.addOption("--max-images", max_images, "images of a source that are measured");
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    const Effort effort = quality == "draft"  ? Effort::draft
                          : quality == "high" ? Effort::high
                                              : Effort::normal;
    Measured result;
    for (const std::string& stem : stems)
        if (const Status measured = measureSource(stem, effort, max_images, result); !measured.ok())
            return reportFailure(measured.error());
    printRoles(result);
    return judge(result, draft);
}

} // namespace

int main(int argc, char** argv)
{
    return runProgram("hearth_measure_textures", [&] { return program(argc, argv); });
}
