// hearth-probe: the light probe of an environment, for reflections.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cookers/words.h"
#include "pipelines/settings/make_setting.h"

namespace hearth::cookers
{

namespace
{

using namespace settings;

constexpr std::string_view kEnvironmentFile = "environment.file";

Result<Arguments> makeProbeArguments(const Values& values)
{
    Arguments arguments;
    addOption(values, "environment.sky_size", "--sky-size", arguments);
    return arguments;
}

} // namespace

Cooker describeProbe()
{
    return {
        .name = "probe",
        .scope = Scope::pack,
        .switched_by = kEnvironmentFile,
        .file_setting = kEnvironmentFile,
        .link_option = "--probe",
        .settings = {withOption({std::string(kEnvironmentFile), Kind::text,
                                 "image of the sky, which the camera and all light see: HDR, "
                                 "EXR or KTX2, twice as wide as high, or a KTX2 cube, in place of that of a "
                                 "source",
                                 "off"},
                                "--sky", "FILE"),
                     withSaving(
                         "a coarser sky takes fewer bytes",
                         wholeNumberSetting("environment.sky_size",
                                            "texels of an edge of the cube that the camera sees, which "
                                            "is no finer than the image",
                                            "512", 1, 4096))},
        .makeArguments = makeProbeArguments,
        // an image of 4096 x 2048 texels
        .cost = {320 * kMiB, 0, 0}};
}

} // namespace hearth::cookers
