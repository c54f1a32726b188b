// hearth-reflections: light probes within the scene, for the reflections and the light of rooms.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/reflections/place/probe_place.h"
#include "pipelines/cookers/words.h"
#include "pipelines/settings/make_setting.h"

namespace hearth::cookers
{

namespace
{

using namespace settings;

constexpr std::string_view kProbes = "reflections.probes";

Status checkPlaces(const std::string& key, const std::string& text)
{
    for (const std::string& place : valueTexts({text, ""}))
        if (const auto parsed = reflections::parseProbePlace(place); !parsed.ok())
            return Error{Issue::profile_value, "", key,
                         "\"" + parsed.error().where + "\": " + parsed.error().detail};
    return success();
}

Setting makePlacesSetting()
{
    Setting setting{
        std::string(kProbes), Kind::texts,
        "positions of light probes within the scene, in metres; with :MIN:MAX, two corners of the "
        "box that a probe lights, and :FADE, the metres over which it fades around the box",
        "off"};
    setting.check = checkPlaces;
    return withOption(std::move(setting), "--probe", "X,Y,Z");
}

Result<Arguments> makeReflectionArguments(const Values& values)
{
    Arguments arguments;
    // rays through the scene, traced in the order of the processor's vectors
    arguments.depends_on_processor = true;
    addOption(values, kProbes, "--at", arguments);
    addOption(values, "reflections.face_size", "--face-size", arguments);
    return arguments;
}

} // namespace

Cooker describeReflections()
{
    return {.name = "reflections",
            .scope = Scope::pack,
            .switched_by = kProbes,
            .reads = {"import", "clusters", "textures"},
            .reads_of_pack = {"probe"},
            .link_option = "--probe",
            .settings = {makePlacesSetting(),
                         withSaving("32 takes a quarter of the rays",
                                    choiceSetting("reflections.face_size",
                                                  "texels of an edge of the cube of a probe within the scene",
                                                  "64", {"32", "64"}, Kind::whole))},
            .makeArguments = makeReflectionArguments,
            .cost = {64 * kMiB, 16, 0.4}};
}

} // namespace hearth::cookers
