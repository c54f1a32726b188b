// Registry of all cookers. The build graph, the settings, the doctor, reports and farms loop over it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/cookers/cooker.h"

#include <span>
#include <string>
#include <string_view>

namespace hearth::cookers
{

/// Return all cookers, each after those that it reads from; the last one is hearth-link.
std::span<const Cooker> allCookers();

/// Find a cooker by its name; nullptr where there is none.
const Cooker* findCooker(std::string_view name);

/// Return the settings of all cookers, those of sources before those of the pack.
std::span<const settings::Setting> profileSettings();

/// True if a cooker runs in a cook.
/// of_sources  settings of the cook's sources; for a cooker of a source usually those of this source alone
bool isEnabled(const Cooker& cooker, const settings::Values& of_pack,
               std::span<const settings::Values> of_sources);

/// Check that the settings of a source make arguments for the cookers that they enable.
/// errors: profile_value
Status checkSourceSettings(const settings::Values& values);

/// Key of the authored LODs of a source. It selects files, so it is not a cooker argument.
inline constexpr std::string_view kImportLods = "import.lods";

/// Key of the files with proxies of a source's meshes.
inline constexpr std::string_view kImportProxies = "import.proxies";

/// Key of the origin of the proxies of a source's meshes.
inline constexpr std::string_view kProxyFrom = "proxy.from";

/// Return the origin of proxies that settings of a source name, or the default.
std::string getProxyFrom(const settings::Values& values);

} // namespace hearth::cookers
