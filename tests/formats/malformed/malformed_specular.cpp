// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/formats/malformed/malformed_packs.h"

#include <limits>

namespace hearth::test
{

const std::vector<MalformedPack>& malformedSpecularTables()
{
    static const std::vector<MalformedPack> list = {
        {"specularTableTwice", Issue::meaning_value, "specular table 1",
         [](PackModel& p) { p.specular_tables.push_back(p.specular_tables[0]); }},
        {"specularApertureNodes", Issue::meaning_value, "specular table 0",
         [](PackModel& p) { p.specular_tables[0].aperture_nodes = 32; }},
        {"specularRoughnessNodes", Issue::meaning_value, "specular table 0",
         [](PackModel& p) { p.specular_tables[0].roughness_nodes = 0; }},
        {"specularBetaNodes", Issue::meaning_value, "specular table 0",
         [](PackModel& p) { p.specular_tables[0].beta_nodes = 17; }},
        {"specularSpacing", Issue::meaning_value, "specular table 0",
         [](PackModel& p) { p.specular_tables[0].spacing = 2; }},
        {"specularMasking", Issue::meaning_value, "specular table 0",
         [](PackModel& p) { p.specular_tables[0].masking = 2; }},
        {"specularLambdaNaN", Issue::meaning_value, "specular table 0",
         [](PackModel& p) { p.specular_tables[0].normal_lambda = std::numeric_limits<float>::quiet_NaN(); }},
        {"specularLambda", Issue::meaning_value, "specular table 0",
         [](PackModel& p) { p.specular_tables[0].normal_lambda = 1.01f; }},
        {"specularRoughness", Issue::meaning_value, "specular table 0",
         [](PackModel& p) { p.specular_tables[0].min_roughness = 0.1f; }},
        {"specularReserved", Issue::meaning_padding, "specular table 0",
         [](PackModel& p) { p.specular_tables[0].reserved = 1; }},
        {"specularFallsWithAperture", Issue::meaning_monotone, "specular table 0",
         [](PackModel& p) { p.specular_tables[0].values[4095] = 1; }},
    };
    return list;
}

} // namespace hearth::test
