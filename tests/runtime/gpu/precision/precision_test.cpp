// Tests which shaders compute in half precision: shading does, and nothing that decides what is visible or
// where it is.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/shaders/shaders.h"
#include "tests/runtime/gpu/precision/relaxed_precision.h"
#include "tests/runtime/shaders/shader_list.h"
#include "tests/support/sanitized.h"

#include <gmock/gmock.h>
#include <map>
#include <string>

namespace hearth::test
{

namespace
{

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Shares of the arithmetic of all features that is relaxed, in per cent: no less than measured. The rest
/// reconstructs the surface, finds light and shadow, and is the distribution of microfacets.
const std::map<std::string, double>& relaxedShares()
{
    static const std::map<std::string, double> shares = {{"shading_frag", 28},
                                                         {"shading_shadowed_frag", 26},
                                                         {"shading_gi_frag", 14},
                                                         {"shading_shadowed_gi_frag", 12.8},
                                                         {"surfaces_frag", 28},
                                                         {"surfaces_sky_frag", 5.8},
                                                         {"surfaces_shadowed_frag", 25},
                                                         {"surfaces_gi_frag", 14},
                                                         {"surfaces_shadowed_gi_frag", 12.7},
                                                         {"summed_frag", 28},
                                                         {"summed_shadowed_frag", 26},
                                                         {"summed_gi_frag", 14},
                                                         {"summed_shadowed_gi_frag", 12.8},
                                                         {"joint_frag", 28},
                                                         {"joint_shadowed_frag", 26},
                                                         {"joint_gi_frag", 14},
                                                         {"joint_shadowed_gi_frag", 12.8},
                                                         {"marked_frag", 27},
                                                         {"marked_shadowed_frag", 21},
                                                         {"marked_gi_frag", 14},
                                                         {"marked_shadowed_gi_frag", 11},
                                                         {"sum_lights_frag", 2.8},
                                                         {"sum_lights_shadowed_frag", 1},
                                                         {"sum_light_volume_frag", 3},
                                                         {"sum_light_volume_shadowed_frag", 1},
                                                         {"join_lights_frag", 2.8},
                                                         {"join_lights_shadowed_frag", 1},
                                                         {"join_light_volume_frag", 3},
                                                         {"join_light_volume_shadowed_frag", 1},
                                                         {"join_encoded_lights_frag", 2.7},
                                                         {"join_encoded_lights_shadowed_frag", 1},
                                                         {"join_encoded_light_volume_frag", 3},
                                                         {"join_encoded_light_volume_shadowed_frag", 1},
                                                         {"add_lights_frag", 20.7},
                                                         {"add_lights_shadowed_frag", 11},
                                                         {"add_light_volume_frag", 23.1},
                                                         {"add_light_volume_shadowed_frag", 11.9}};
    return shares;
}

/// Return the name of a shader without that of its way through a frame.
std::string baseName(std::string name)
{
    constexpr std::string_view kVariant = "_sampled";
    if (const size_t at = name.find(kVariant); at != std::string::npos)
        name.erase(at, kVariant.size());
    return name;
}

/// Debug views, the background, final passes and counts of lights shade, too; the rest decides what is
/// drawn where, or must be the CPU's to the bit.
bool shades(const std::string& shader)
{
    const std::string name = baseName(shader);
    return relaxedShares().contains(name) || name.starts_with("view_") || name.starts_with("final_") ||
           name == "sky_frag" || name == "light_statistics_comp";
}

/// Return whether a shader that shades computes where it reads textures or shadow maps: lights that cast no
/// shadow read buffers and the pixel's own attachments, the sky reads along the view.
bool readsTexels(const std::string& name)
{
    const bool adds_lights =
        name.starts_with("add_") || name.starts_with("sum_") || name.starts_with("join_");
    return name != "surfaces_sky_frag" && (!adds_lights || name.find("_shadowed") != std::string::npos);
}

/// True if a shader is rewritten to see that a test can fail: a sanitizer takes long for all ways through a
/// frame.
bool isRewritten(const std::string& name)
{
    return !kSanitized || baseName(name) == name;
}

double relaxedShare(std::span<const uint32_t> words)
{
    const PrecisionCounts counts = countPrecisions(words);
    return 100.0 * counts.relaxed / counts.arithmetic;
}

} // namespace

TEST(PrecisionTest, shadingIsRelaxed)
{
    size_t found = 0;
    for (const ListedShader& shader : listedShaders())
        if (const auto share = relaxedShares().find(baseName(shader.name)); share != relaxedShares().end())
        {
            const PrecisionCounts counts = countPrecisions(shader.words);
            std::printf("%-26s %u of %u relaxed, %.1f %%\n", shader.name, counts.relaxed, counts.arithmetic,
                        relaxedShare(shader.words));
            EXPECT_GE(relaxedShare(shader.words), share->second) << shader.name;
            EXPECT_LT(relaxedShare(shader.words), 100) << shader.name;
            if (isRewritten(shader.name))
            {
                EXPECT_DOUBLE_EQ(relaxedShare(relaxEverything(shader.words)), 100) << shader.name;
            }
            ++found;
        }
    EXPECT_EQ(found, shaders::kVariantCount * relaxedShares().size())
        << "of all ways to read the visibility buffer";
}

TEST(PrecisionTest, allElseIsFull)
{
    size_t full = 0;
    for (const ListedShader& shader : listedShaders())
        if (!shades(shader.name))
        {
            EXPECT_FALSE(hasRelaxedPrecision(shader.words)) << shader.name;
            ++full;
        }
    EXPECT_GT(full, 30u);
}

/// Positions, barycentrics and normals of triangles are full where shading reads textures and shadow maps
/// by them.
TEST(PrecisionTest, placesInTexturesAreFull)
{
    for (const ListedShader& shader : listedShaders())
    {
        if (!shades(shader.name))
            continue;
        EXPECT_THAT(findRelaxedPlaces(shader.words), IsEmpty()) << shader.name;
        const std::string name = baseName(shader.name);
        if (relaxedShares().contains(name) && readsTexels(name) && isRewritten(shader.name))
        {
            EXPECT_THAT(findRelaxedPlaces(relaxEverything(shader.words)), Contains(HasSubstr("value ")))
                << shader.name;
        }
    }
}

} // namespace hearth::test
