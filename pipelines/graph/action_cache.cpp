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
constexpr const char* kList = "list";
// Placeholder for the subject at the start of a cached warning: another cook may name it by another path.
constexpr char kSubject = '\1';

/// Return the found files of a record, without its declared fields.
Record foundFields(const Record& record)
{
    Record found;
    for (const auto& field : record)
        if (field.first.starts_with(kFound))
            found.push_back(field);
    return found;
}

Record declaredFields(const Record& record)
{
    Record declared;
    for (const auto& field : record)
        if (!field.first.starts_with(kFound))
            declared.push_back(field);
    return declared;
}

std::string maskSubject(const std::string& line, const std::string& subject)
{
    const bool names_subject = line.starts_with(subject) && line.size() > subject.size() &&
                               (line[subject.size()] == ':' || line[subject.size()] == '|');
    return names_subject ? kSubject + line.substr(subject.size()) : line;
}

cache::Fields resultFields(const Action& action, const CachedResult& result)
{
    cache::Fields fields;
    for (const CachedOutput& output : result.outputs)
    {
        fields.emplace_back(cache::kContentField, output.hash);
        fields.emplace_back("bytes", std::to_string(output.bytes));
    }
    for (const std::string& warning : result.warnings)
        fields.emplace_back("warning", maskSubject(warning, action.subject));
    if (action.is_lister)
        fields.emplace_back(kList, result.list);
    fields.emplace_back("milliseconds", fmt::format("{:.0f}", result.seconds * 1e3));
    fields.emplace_back("cpu_milliseconds", fmt::format("{:.0f}", result.cpu_seconds * 1e3));
    fields.emplace_back("peak_rss_bytes", std::to_string(result.peak_rss_bytes));
    return fields;
}

/// Merge two lists of findings.
cache::Fields mergeFindings(const cache::Fields& first, const cache::Fields& second)
{
    cache::Fields merged = first;
    for (const auto& finding : second)
        if (merged.size() < kMaxFindings && std::find(merged.begin(), merged.end(), finding) == merged.end())
            merged.push_back(finding);
    return merged;
}

uint64_t parseNumber(std::string_view text)
{
    uint64_t number = 0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    return number;
}

/// Parse the result of an action; nullopt where the entry does not belong to such an action.
std::optional<CachedResult> parseResult(const Action& action, const cache::Fields& fields)
{
    CachedResult result;
    for (const auto& [name, value] : fields)
        if (name == cache::kContentField)
            result.outputs.push_back({value, 0});
        else if (name == "bytes" && !result.outputs.empty())
            result.outputs.back().bytes = parseNumber(value);
        else if (name == "warning")
            result.warnings.push_back(value.starts_with(kSubject) ? action.subject + value.substr(1) : value);
    result.list = cache::fieldValue(fields, kList);
    result.seconds = static_cast<double>(parseNumber(cache::fieldValue(fields, "milliseconds"))) * 1e-3;
    result.cpu_seconds =
        static_cast<double>(parseNumber(cache::fieldValue(fields, "cpu_milliseconds"))) * 1e-3;
    result.peak_rss_bytes = parseNumber(cache::fieldValue(fields, "peak_rss_bytes"));
    return result.outputs.size() == action.outputs.size() ? std::optional(std::move(result)) : std::nullopt;
}

} // namespace

std::vector<std::string> listHashes(const CachedResult& result)
{
    std::vector<std::string> hashes;
    for (const CachedOutput& output : result.outputs)
        hashes.push_back(output.hash);
    return hashes;
}

std::optional<std::vector<std::string>> findPartHashes(const Action& action, const OutputHashes& hashes)
{
    std::vector<std::string> part_hashes;
    for (const Input& input : action.inputs)
    {
        if (input.action != kNoAction && hashes[input.action].empty())
            return std::nullopt;
        part_hashes.push_back(input.action == kNoAction ? "" : hashes[input.action][input.output]);
    }
    return part_hashes;
}

std::string ActionCache::versionOfCooker(const std::string& cooker)
{
    const auto [known, is_new] = version_of_cooker_.emplace(cooker, "");
    if (is_new)
        known->second = cookerVersion(programs_ + "/hearth-" + cooker, hashes_);
    return known->second;
}

std::string ActionCache::resolveFolder(const std::string& path)
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

std::optional<Record> ActionCache::makeRecord(const Action& action,
                                              const std::vector<std::string>& part_hashes)
{
    const std::string version = versionOfCooker(action.cooker);
    if (version.empty())
        return std::nullopt;
    std::vector<std::string> hashes = part_hashes;
    for (size_t i = 0; i < action.inputs.size(); ++i)
    {
        if (action.inputs[i].action != kNoAction)
            continue;
        const std::optional<std::string> hash = hashes_.hashFile(action.inputs[i].path);
        if (!hash)
            return std::nullopt;
        hashes[i] = *hash;
    }
    return graph::makeRecord(action, version, hashes);
}

/// Return the path of a found file from its field name; empty where the action has no input of that role.
std::string ActionCache::foundFilePath(const Action& action, const std::string& found)
{
    const size_t slash = found.find('/', kFound.size());
    const std::string role = found.substr(kFound.size(), slash - kFound.size());
    for (const Input& input : action.inputs)
        if (input.role == role && slash != std::string::npos)
            return resolveFolder(input.path) + found.substr(slash + 1);
    return "";
}

std::string ActionCache::currentHash(const Action& action, const std::string& found)
{
    const std::string path = foundFilePath(action, found);
    return path.empty() ? std::string(kAbsent) : hashes_.hashFile(path).value_or(std::string(kAbsent));
}

std::vector<std::string> ActionCache::probedFiles(const Action& action, const Record& record)
{
    std::vector<std::string> paths;
    for (const auto& [name, hash] : record)
        if (name.starts_with(kFound))
            paths.push_back(foundFilePath(action, name));
    return paths;
}

Record ActionCache::withCurrentHashes(const Action& action, const Record& record)
{
    Record now = record;
    for (auto& [name, value] : now)
        if (name.starts_with(kFound))
            value = currentHash(action, name);
    return now;
}

/// Append the findings whose hashes hold now to the record; nullopt where none do.
std::optional<Record> ActionCache::completeRecord(const Action& action, const Record& record,
                                                  const cache::Fields& findings)
{
    for (const auto& [name, text] : findings)
    {
        const std::optional<Record> found = cache::parseFields(text);
        if (!found || withCurrentHashes(action, *found) != *found)
            continue;
        Record whole = record;
        whole.insert(whole.end(), found->begin(), found->end());
        return whole;
    }
    return std::nullopt;
}

std::optional<Record> ActionCache::recordFromFindings(const Action& action, const Record& record)
{
    std::optional<Record> whole;
    const auto areCurrent = [&](const cache::Fields& findings)
    {
        whole = completeRecord(action, record, findings);
        return whole.has_value();
    };
    cache_.entry(findingsKey(record), areCurrent, mergeFindings);
    return whole;
}

ActionCache::LookupResult ActionCache::find(const Action& action, const Record& record)
{
    const std::optional<Record> whole = action.finds_files ? recordFromFindings(action, record) : record;
    if (!whole)
        return {record, std::nullopt, cache_.wasDamaged(findingsKey(record))};
    const std::string key = resultKey(*whole);
    const std::optional<cache::Fields> entry = cache_.entry(key);
    return {*whole, entry ? parseResult(action, *entry) : std::nullopt, cache_.wasDamaged(key)};
}

std::optional<Record> ActionCache::recordFromReads(const Action& action, const Record& record,
                                                   const tools::DependencyList& reads)
{
    Record found;
    for (const auto& [path, hash] : reads.files())
    {
        // the file must still have the content that was read, else nothing is cached
        if (hashes_.hashFile(path) != hash)
            return std::nullopt;
        const auto is_declared = [&](const Input& input) { return input.path == path; };
        if (std::any_of(action.inputs.begin(), action.inputs.end(), is_declared))
            continue;
        const auto holds = [&](const Input& input)
        { return input.action == kNoAction && path.starts_with(resolveFolder(input.path)); };
        const auto input = std::find_if(action.inputs.begin(), action.inputs.end(), holds);
        if (input == action.inputs.end())
            return std::nullopt;
        const std::string name = path.substr(resolveFolder(input->path).size());
        found.emplace_back(std::string(kFound) + input->role + "/" + name,
                           hash.value_or(std::string(kAbsent)));
    }
    // findings of an earlier run do not matter
    Record whole = declaredFields(record);
    whole.insert(whole.end(), found.begin(), found.end());
    return whole;
}

void ActionCache::store(const Action& action, const Record& record, const CachedResult& result)
{
    cache_.putEntry(resultKey(record), resultFields(action, result));
    if (!action.finds_files)
        return;
    // last, so that a reader of the list also finds the result
    cache_.putEntry(findingsKey(declaredFields(record)),
                    {{kFindings, cache::formatFields(foundFields(record))}}, mergeFindings);
}

} // namespace hearth::graph
