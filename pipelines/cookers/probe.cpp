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

} // namespace

Cooker describeProbe()
{
    return {.name = "probe",
            .scope = Scope::pack,
            .switched_by = kEnvironmentFile,
            .file_setting = kEnvironmentFile,
            .link_option = "--probe",
            .settings = {withOption(
                {std::string(kEnvironmentFile), Kind::text,
                 "image of the distant surroundings, of which the pack gets a light probe: HDR, "
                 "EXR or KTX2, twice as wide as high, or a KTX2 cube",
                 "off"},
                "--sky", "FILE")},
            // an image of 4096 x 2048 texels
            .cost = {320 * kMiB, 0, 0}};
}

} // namespace hearth::cookers
