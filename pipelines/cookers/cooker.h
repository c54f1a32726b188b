// Description of a cooker: everything that the other folders of pipelines/ know about it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/settings/setting.h"
#include "pipelines/settings/value.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::cookers
{

/// Command-line words of a cooker, without those for its files.
struct Arguments
{
    std::vector<std::string> words;
    bool depends_on_processor = false; ///< output bytes are equal only on processors of one class
};

/// Estimated resources of a cooker, linear in the bytes of its sources.
struct Cost
{
    uint64_t base_bytes = 0;    ///< memory for an empty source: program, libraries, threads
    double bytes_per_byte = 0;  ///< peak memory per byte of source
    double seconds_per_mib = 0; ///< seconds per MiB of source, on two cores
};

/// Content of a list with a line for each source, which changes the actions of these sources.
enum class Lists : uint8_t
{
    nothing,    ///< the cooker writes no list
    neighbours, ///< numbers of sources: their parts become inputs
    words,      ///< values of an option: they become words of the command
};

struct Cooker
{
    std::string_view name; ///< "clusters": the program is hearth-clusters
    /// true: it may not be installed with the others, as for its licence
    bool has_package_of_its_own = false;
    /// source: runs once for each source; pack: runs once for all sources
    settings::Scope scope = settings::Scope::source;
    /// key of the setting that switches the cooker (settings::switchSetting, or a list): it runs unless this
    /// is off, or an empty list, or as runsFor says; empty: it always runs
    std::string_view switched_by{};
    /// True if the cooker runs, by the settings of a source or of the pack; null: by that setting alone
    bool (*runsFor)(const settings::Values& values) = nullptr;
    /// Cookers whose parts it reads, in the order of its command line. A cooker of the pack reads the parts
    /// of each source. A part that is not made, because its cooker is off, is left out.
    std::vector<std::string_view> reads{};
    /// Cookers of sources that need not run, whose parts it reads, too, each after the link option of that
    /// cooker, "--proxies"; a cooker of the pack gets them with the source's number, "0="
    std::vector<std::string_view> reads_of_some{};
    /// True if it reads these, by the settings of its scope; null: always
    bool (*needsSome)(const settings::Values& values) = nullptr;
    /// For a cooker of the pack: earlier ones of the pack whose parts it reads where they run, each after an
    /// option of that name, "--probe"
    std::vector<std::string_view> reads_of_pack{};
    /// true: it reads the statistics of these cookers instead of their parts
    bool reads_statistics = false;
    /// Cooker of the pack whose list says what more the cooker gets for each source; empty: none
    std::string_view listed_by{};
    /// True if a cooker needs that list; null: wherever the cooker that writes it is enabled
    bool (*needsList)(const settings::Values& values) = nullptr;
    /// content of its part as a list; it runs only where a cooker needs the list
    Lists lists = Lists::nothing;
    /// cooker of the pack without which it does not run, since no other reads its part; empty: none
    std::string_view needed_by{};
    /// true: it reads the source's files, its authored LODs, and files that these name
    bool reads_files = false;
    /// Setting of the pack that names a file, which a cooker of the pack reads first; empty: none
    std::string_view file_setting{};
    /// true: hearth-link reads its part; false: the part is for other cookers, or only for reports
    bool is_linked = true;
    /// cooker whose chunks its part contains too: where it runs, only its own part is linked; empty: none
    std::string_view replaces{};
    /// option of hearth-link before the part of a cooker of the pack; and of one of sources that need not
    /// run, whose part has the source's number before it, "0="
    std::string_view link_option{};
    std::string_view extension = ".part"; ///< of its output's name
    bool has_statistics = false;          ///< true: with --stats it writes JSON about its work, for reports
    /// option for an image of its result, for reports; empty: none
    std::string_view image_option{};
    std::vector<settings::Setting> settings{};
    /// Convert settings into arguments; null: it has none. Unset settings are omitted, so changing a default
    /// only re-keys that setting. errors: profile_value where settings contradict each other
    Result<Arguments> (*makeArguments)(const settings::Values& values) = nullptr;
    /// Return further words of a cooker of sources, by settings of the pack; null: none
    std::vector<std::string> (*makeWordsOfPack)(const settings::Values& values) = nullptr;
    Cost cost{};
};

} // namespace hearth::cookers
