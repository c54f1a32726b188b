// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/graph/action_record.h"

#include "cook/tools/sha256.h"
#include "pipelines/graph/cooker_version.h"

namespace hearth::graph
{

namespace
{

std::string wordText(const Action& action, const Word& word)
{
    switch (word.kind)
    {
    case Word::Kind::input:
        return "input " + word.text + "{" + action.inputs[word.index].role + "}";
    case Word::Kind::output:
        return "output " + word.text + "{" + action.outputs[word.index] + "}";
    case Word::Kind::text:
        break;
    }
    return "text " + word.text;
}

} // namespace

Record makeRecord(const Action& action, const std::string& cooker_version,
                  const std::vector<std::string>& input_hashes)
{
    Record record{{"schema", "hearth.action/1"}, {"cooker", action.cooker}, {"version", cooker_version}};
    if (action.depends_on_processor)
        record.emplace_back("processor", processorClass());
    for (const Word& word : action.words)
        record.emplace_back("word", wordText(action, word));
    for (size_t i = 0; i < action.inputs.size(); ++i)
    {
        const Input& input = action.inputs[i];
        const bool is_users = input.action == kNoAction;
        record.emplace_back("input " + input.role,
                            input_hashes[i] +
                                (is_users ? " " + input.path.substr(input.path.rfind('/') + 1) : ""));
    }
    for (const std::string& output : action.outputs)
        record.emplace_back("output", output);
    return record;
}

std::string resultKey(const Record& record)
{
    return tools::computeSha256("result\n" + cache::formatFields(record));
}

std::string findingsKey(const Record& record_without_found)
{
    return tools::computeSha256("findings\n" + cache::formatFields(record_without_found));
}

} // namespace hearth::graph
