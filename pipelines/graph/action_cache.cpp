// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/graph/action_cache.h"

#include "pipelines/graph/cooker_version.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <fmt/format.h>
#include <memory>

namespace hearth::graph
{

namespace
{

// Number of findings kept for an action: a source that is switched between states finds each again; more
// would not be worth the time to read them.
constexpr size_t kMaxFindings = 16;
constexpr const char* kFindings = "findings";
// Placeholder for the subject at the start of a cached warning: another cook may name it by another path.
constexpr char kSubject = '\1';

/// Return the found files of a record, without its declared fields.
Record foundOf(const Record& record)
{
    Record found;
    for (const auto& field : record)
        if (field.first.starts_with(kFound))
            found.push_back(field);
    return found;
}

Record declaredOf(const Record& record)
{
    Record declared;
    for (const auto& field : record)
        if (!field.first.starts_with(kFound))
            declared.push_back(field);
    return declared;
}

std::string keptWarning(const std::string& line, const std::string& subject)
{
    const bool names_subject = line.starts_with(subject) && line.size() > subject.size() &&
                               (line[subject.size()] == ':' || line[subject.size()] == '|');
    return names_subject ? kSubject + line.substr(subject.size()) : line;
}

cache::Fields fieldsOf(const Action& action, const KeptResult& result)
{
    cache::Fields fields;
    for (const KeptOutput& output : result.outputs)
    {
        fields.emplace_back(cache::kContentField, output.hash);
        fields.emplace_back("bytes", std::to_string(output.bytes));
    }
    for (const std::string& warning : result.warnings)
        fields.emplace_back("warning", keptWarning(warning, action.subject));
    fields.emplace_back("milliseconds", fmt::format("{:.0f}", result.seconds * 1e3));
    fields.emplace_back("cpu_milliseconds", fmt::format("{:.0f}", result.cpu_seconds * 1e3));
    fields.emplace_back("peak_rss_bytes", std::to_string(result.peak_rss_bytes));
    return fields;
}

/// Merge two lists of findings.
cache::Fields mergedFindings(const cache::Fields& first, const cache::Fields& second)
{
    cache::Fields merged = first;
    for (const auto& finding : second)
        if (merged.size() < kMaxFindings && std::find(merged.begin(), merged.end(), finding) == merged.end())
            merged.push_back(finding);
    return merged;
}

uint64_t numberOf(std::string_view text)
{
    uint64_t number = 0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    return number;
}

/// Parse the result of an action; nullopt where the entry does not belong to such an action.
std::optional<KeptResult> resultOf(const Action& action, const cache::Fields& fields)
{
    KeptResult result;
    for (const auto& [name, value] : fields)
        if (name == cache::kContentField)
            result.outputs.push_back({value, 0});
        else if (name == "bytes" && !result.outputs.empty())
            result.outputs.back().bytes = numberOf(value);
        else if (name == "warning")
            result.warnings.push_back(value.starts_with(kSubject) ? action.subject + value.substr(1) : value);
    result.seconds = static_cast<double>(numberOf(cache::valueOf(fields, "milliseconds"))) * 1e-3;
    result.cpu_seconds = static_cast<double>(numberOf(cache::valueOf(fields, "cpu_milliseconds"))) * 1e-3;
    result.peak_rss_bytes = numberOf(cache::valueOf(fields, "peak_rss_bytes"));
    return result.outputs.size() == action.outputs.size() ? std::optional(std::move(result)) : std::nullopt;
}

} // namespace

std::string ActionCache::versionOf(const std::string& cooker)
{
    const auto [known, is_new] = version_of_cooker_.emplace(cooker, "");
    if (is_new)
        known->second = cookerVersion(programs_ + "/hearth-" + cooker, hashes_);
    return known->second;
}

std::string ActionCache::realFolderOf(const std::string& path)
{
    const auto [known, is_new] = real_folder_of_path_.emplace(path, "");
    if (is_new)
    {
        const std::unique_ptr<char, decltype(&std::free)> real(::realpath(path.c_str(), nullptr), &std::free);
        const std::string file = real ? real.get() : path;
        known->second = file.substr(0, file.rfind('/') + 1);
    }
    return known->second;
}

std::optional<Record> ActionCache::recordOf(const Action& action, const std::vector<std::string>& part_hashes)
{
    const std::string version = versionOf(action.cooker);
    if (version.empty())
        return std::nullopt;
    std::vector<std::string> hashes = part_hashes;
    for (size_t i = 0; i < action.inputs.size(); ++i)
    {
        if (action.inputs[i].action != kNoAction)
            continue;
        const std::optional<std::string> hash = hashes_.hashOf(action.inputs[i].path);
        if (!hash)
            return std::nullopt;
        hashes[i] = *hash;
    }
    return graph::recordOf(action, version, hashes);
}

/// Return the path of a found file from its field name; empty where the action has no input of that role.
std::string ActionCache::pathOfFound(const Action& action, const std::string& found)
{
    const size_t slash = found.find('/', kFound.size());
    const std::string role = found.substr(kFound.size(), slash - kFound.size());
    for (const Input& input : action.inputs)
        if (input.role == role && slash != std::string::npos)
            return realFolderOf(input.path) + found.substr(slash + 1);
    return "";
}

std::string ActionCache::hashNow(const Action& action, const std::string& found)
{
    const std::string path = pathOfFound(action, found);
    return path.empty() ? std::string(kAbsent) : hashes_.hashOf(path).value_or(std::string(kAbsent));
}

std::vector<std::string> ActionCache::filesLookedFor(const Action& action, const Record& record)
{
    std::vector<std::string> paths;
    for (const auto& [name, hash] : record)
        if (name.starts_with(kFound))
            paths.push_back(pathOfFound(action, name));
    return paths;
}

Record ActionCache::refreshed(const Action& action, const Record& record)
{
    Record now = record;
    for (auto& [name, value] : now)
        if (name.starts_with(kFound))
            value = hashNow(action, name);
    return now;
}

/// Append the findings whose hashes hold now to the record; nullopt where none do.
std::optional<Record> ActionCache::wholeRecord(const Action& action, const Record& record,
                                               const cache::Fields& findings)
{
    for (const auto& [name, text] : findings)
    {
        const std::optional<Record> found = cache::fieldsOf(text);
        if (!found || refreshed(action, *found) != *found)
            continue;
        Record whole = record;
        whole.insert(whole.end(), found->begin(), found->end());
        return whole;
    }
    return std::nullopt;
}

std::optional<Record> ActionCache::recordByFindings(const Action& action, const Record& record)
{
    std::optional<Record> whole;
    const auto holdNow = [&](const cache::Fields& findings)
    {
        whole = wholeRecord(action, record, findings);
        return whole.has_value();
    };
    cache_.entry(findingsKey(record), holdNow, mergedFindings);
    return whole;
}

ActionCache::Found ActionCache::find(const Action& action, const Record& record)
{
    const std::optional<Record> whole = action.finds_files ? recordByFindings(action, record) : record;
    if (!whole)
        return {record, std::nullopt, cache_.wasDamaged(findingsKey(record))};
    const std::string key = resultKey(*whole);
    const std::optional<cache::Fields> entry = cache_.entry(key);
    return {*whole, entry ? resultOf(action, *entry) : std::nullopt, cache_.wasDamaged(key)};
}

std::optional<Record> ActionCache::recordAfter(const Action& action, const Record& record,
                                               const tools::ReadList& reads)
{
    Record found;
    for (const auto& [path, hash] : reads.files())
    {
        // the file must still have the content that was read, else nothing is cached
        if (hashes_.hashOf(path) != hash)
            return std::nullopt;
        const auto is_declared = [&](const Input& input) { return input.path == path; };
        if (std::any_of(action.inputs.begin(), action.inputs.end(), is_declared))
            continue;
        const auto holds = [&](const Input& input)
        { return input.action == kNoAction && path.starts_with(realFolderOf(input.path)); };
        const auto input = std::find_if(action.inputs.begin(), action.inputs.end(), holds);
        if (input == action.inputs.end())
            return std::nullopt;
        const std::string name = path.substr(realFolderOf(input->path).size());
        found.emplace_back(std::string(kFound) + input->role + "/" + name,
                           hash.value_or(std::string(kAbsent)));
    }
    // findings of an earlier run do not matter
    Record whole = declaredOf(record);
    whole.insert(whole.end(), found.begin(), found.end());
    return whole;
}

void ActionCache::keep(const Action& action, const Record& record, const KeptResult& result)
{
    cache_.putEntry(resultKey(record), fieldsOf(action, result));
    if (!action.finds_files)
        return;
    // last, so that a reader of the list also finds the result
    cache_.putEntry(findingsKey(declaredOf(record)), {{kFindings, cache::textOf(foundOf(record))}},
                    mergedFindings);
}

} // namespace hearth::graph
