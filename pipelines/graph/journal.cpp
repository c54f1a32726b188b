// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/graph/journal.h"

#include "cook/tools/sha256.h"
#include "pipelines/cache/entry_text.h"
#include "pipelines/graph/plan_json.h"

#include <algorithm>
#include <array>
#include <filesystem>

namespace hearth::graph
{

namespace
{

constexpr const char* kJournalSchema = "hearth.cook/1";
constexpr std::array<std::string_view, 5> kOutcomeNames{"unknown", "cooked", "kept", "failed", "left out"};

} // namespace

std::string journalText(const Journal& journal)
{
    cache::Fields fields{{"schema", kJournalSchema},
                         {"folder", journal.folder},
                         {"output", journal.output},
                         {"output cause", journal.output_cause},
                         {"plan", planJson(journal.graph)}};
    for (const JournalAction& action : journal.actions)
    {
        fields.emplace_back("ending", kOutcomeNames[static_cast<size_t>(action.ending)]);
        fields.emplace_back("record", cache::formatFields(action.record));
        for (const std::string& cause : action.causes)
            fields.emplace_back("cause", cause);
    }
    return cache::formatEntry(fields);
}

std::optional<Journal> parseJournal(std::string_view text)
{
    const std::optional<cache::Fields> fields = cache::parseEntry(text);
    if (!fields || cache::fieldValue(*fields, "schema") != kJournalSchema)
        return std::nullopt;
    Journal journal;
    journal.folder = cache::fieldValue(*fields, "folder");
    journal.output = cache::fieldValue(*fields, "output");
    journal.output_cause = cache::fieldValue(*fields, "output cause");
    Result<Graph> graph = parsePlan(cache::fieldValue(*fields, "plan"), "");
    if (!graph.ok())
        return std::nullopt;
    journal.graph = std::move(graph).value();
    for (const auto& [name, value] : *fields)
        if (name == "ending")
        {
            const auto ending = std::find(kOutcomeNames.begin(), kOutcomeNames.end(), value);
            if (ending == kOutcomeNames.end())
                return std::nullopt;
            journal.actions.emplace_back().ending = static_cast<Outcome>(ending - kOutcomeNames.begin());
        }
        else if (name == "record" && !journal.actions.empty())
            journal.actions.back().record = cache::parseFields(value).value_or(Record());
        else if (name == "cause" && !journal.actions.empty())
            journal.actions.back().causes.push_back(value);
    return journal.actions.size() == journal.graph.actions.size() ? std::optional(std::move(journal))
                                                                  : std::nullopt;
}

std::string workingFolder()
{
    std::error_code error;
    return std::filesystem::current_path(error).string();
}

std::string absolutePath(const std::string& path)
{
    std::error_code error;
    return std::filesystem::absolute(path, error).lexically_normal().string();
}

std::string journalPath(const std::string& cache_folder, const std::string& output)
{
    return cache_folder + "/cooks/" + tools::computeSha256(absolutePath(output));
}

} // namespace hearth::graph
