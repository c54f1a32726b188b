// hearth-clusters: hierarchies of clusters from the meshes of a source.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/core/reduction.h"
#include "cook/clusters/program/profile.h"
#include "pipelines/cookers/registry.h"
#include "pipelines/cookers/words.h"
#include "pipelines/settings/make_setting.h"

namespace hearth::cookers
{

namespace
{

using namespace settings;

constexpr double kMaxWeight = double{clusters::kMaxErrorWeight};

Setting levelsSetting(const std::string& key)
{
    return tablesSetting(
        key, "entry k says what level of detail k becomes of the level below; the last one repeats",
        "[{keep=0.5,error_weight=1}]",
        {numberSetting("keep", "triangles that a group keeps, as part of what it has", "0.5",
                       double{clusters::kMinKeep}, double{clusters::kMaxKeep}),
         numberSetting("error_weight",
                       "factor on the stored error: what replaces a group is drawn where so much more error "
                       "is allowed",
                       "1", 1, kMaxWeight)});
}

/// Return the settings for all meshes, or for the meshes of a rule.
std::vector<Setting> meshSettings(const std::string& prefix)
{
    return {
        choiceSetting(prefix + "influences",
                      "joints that move a vertex of a skinned mesh at most: those with the largest weights",
                      "8", {"4", "8"}, Kind::whole),
        choiceSetting(prefix + "normal_bits", "bits of each of the two parts of a normal's code",
                      "16 where the surface is smooth, else 8", {"8", "16"}, Kind::whole),
        numberSetting(prefix + "normal_error_weight", "what turned normals count in the error", "1", 0,
                      kMaxWeight),
        numberSetting(prefix + "uv_error_weight", "what shifted UVs count in the error", "0.25", 0,
                      kMaxWeight),
    };
}

std::vector<Setting> meshMembers()
{
    std::vector<Setting> members{
        asRequired({"name", Kind::text, "meshes whose name this pattern matches; * and ? are wildcards", ""}),
        levelsSetting("levels"),
        tablesSetting(
            "targets", "how many triangles a level shall have; levels rise, triangles fall", "",
            {asRequired(wholeNumberSetting("level", "the level of detail", "", 1, kMaxWholeNumber)),
             asRequired(wholeNumberSetting("triangles", "that are drawn at it", "", 1, kMaxWholeNumber))}),
    };
    for (Setting& setting : meshSettings(""))
        members.push_back(std::move(setting));
    return members;
}

/// Check a value with the cooker's own parser: several members may contradict each other.
Status checkProfile(const std::string& key, const std::string& text)
{
    const auto profile = clusters::parseProfile(key + "=" + text, "");
    return profile.ok() ? success() : Status(profile.error());
}

std::vector<Setting> makeClusterSettings()
{
    std::vector<Setting> settings{
        withSaving("a smaller keep makes fewer levels", levelsSetting("clusters.levels"))};
    for (Setting& setting : meshSettings("clusters."))
        settings.push_back(std::move(setting));
    settings.push_back(tablesSetting("clusters.mesh", "rules for meshes: the first whose name matches holds",
                                     "", meshMembers()));
    settings.push_back(tablesSetting(
        "clusters.material", "rules for materials in any mesh: the first whose name matches holds", "",
        {asRequired({"name", Kind::text, "materials whose name this pattern matches", ""}),
         asRequired(levelsSetting("levels"))}));
    for (Setting& setting : settings)
        setting.check = checkProfile;
    return settings;
}

Result<Arguments> makeClusterArguments(const Values& values)
{
    Arguments arguments;
    addAssignments(values, "clusters", arguments);
    // the comparison with discrete LODs would take a third as long as the work itself
    arguments.words.emplace_back("--no-discrete-lods");
    if (settings::choiceOr(values, "visibility.mode", "auto") != "off")
        arguments.words.emplace_back("--visibility");
    return arguments;
}

} // namespace

Cooker describeClusters()
{
    return {.name = "clusters",
            .reads = {"import"},
            .has_statistics = true,
            .settings = makeClusterSettings(),
            .makeArguments = makeClusterArguments,
            .cost = {16 * kMiB, 8, 0.2}};
}

} // namespace hearth::cookers
