// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/graph/plan_json.h"

#include "cook/json/json.h"

namespace hearth::graph
{

namespace
{

constexpr const char* kPlanSchema = "hearth.plan/1";

Json wordJson(const Word& word)
{
    if (word.kind == Word::Kind::text)
        return word.text;
    Json json{{word.kind == Word::Kind::input ? "input" : "output", word.index}};
    if (!word.text.empty())
        json["before"] = word.text;
    return json;
}

Json inputJson(const Input& input)
{
    if (input.action == kNoAction)
        return {{"role", input.role}, {"path", input.path}};
    Json json{{"role", input.role}, {"action", input.action}};
    if (input.output != 0)
        json["output"] = input.output;
    return json;
}

Json actionJson(const Action& action)
{
    Json json{{"cooker", action.cooker}, {"source", action.source}, {"subject", action.subject},
              {"words", Json::array()},  {"inputs", Json::array()}, {"outputs", action.outputs}};
    for (const Word& word : action.words)
        json["words"].push_back(wordJson(word));
    for (const Input& input : action.inputs)
        json["inputs"].push_back(inputJson(input));
    if (action.is_lister)
        json["is_lister"] = true;
    if (action.lister != kNoAction)
        json["lister"] = action.lister;
    if (action.finds_files)
        json["finds_files"] = true;
    if (action.depends_on_processor)
        json["depends_on_processor"] = true;
    json["estimate"] = {{"memory_bytes", action.estimate.memory_bytes}, {"seconds", action.estimate.seconds}};
    return json;
}

Word parseWord(const Json& json)
{
    if (json.is_string())
        return {Word::Kind::text, json.get<std::string>(), 0};
    const bool is_input = json.contains("input");
    return {is_input ? Word::Kind::input : Word::Kind::output, json.value("before", ""),
            json.at(is_input ? "input" : "output").get<size_t>()};
}

Action parseAction(const Json& json)
{
    Action action;
    json.at("cooker").get_to(action.cooker);
    json.at("source").get_to(action.source);
    json.at("subject").get_to(action.subject);
    json.at("outputs").get_to(action.outputs);
    for (const Json& word : json.at("words"))
        action.words.push_back(parseWord(word));
    for (const Json& input : json.at("inputs"))
        action.inputs.push_back({input.at("role").get<std::string>(), input.value("action", kNoAction),
                                 input.value("path", ""), input.value("output", size_t{0})});
    action.is_lister = json.value("is_lister", false);
    action.lister = json.value("lister", kNoAction);
    action.finds_files = json.value("finds_files", false);
    action.depends_on_processor = json.value("depends_on_processor", false);
    json.at("estimate").at("memory_bytes").get_to(action.estimate.memory_bytes);
    json.at("estimate").at("seconds").get_to(action.estimate.seconds);
    return action;
}

/// True if every index is in range and each action comes after the actions that it reads from.
bool isConsistent(const Graph& graph)
{
    for (size_t i = 0; i < graph.actions.size(); ++i)
    {
        const Action& action = graph.actions[i];
        for (const Word& word : action.words)
            if ((word.kind == Word::Kind::input && word.index >= action.inputs.size()) ||
                (word.kind == Word::Kind::output && word.index >= action.outputs.size()))
                return false;
        for (const Input& input : action.inputs)
            if (input.action != kNoAction &&
                (input.action >= i || input.output >= graph.actions[input.action].outputs.size()))
                return false;
        if (action.lister != kNoAction && action.lister >= i)
            return false;
        if (action.outputs.empty() || action.source > graph.source_count)
            return false;
    }
    return !graph.actions.empty();
}

} // namespace

std::string planJson(const Graph& graph)
{
    Json json{{"schema", kPlanSchema}, {"sources", graph.source_count}, {"actions", Json::array()}};
    for (const Action& action : graph.actions)
        json["actions"].push_back(actionJson(action));
    return json.dump(1) + "\n";
}

Result<Graph> parsePlan(std::string_view text, const std::string& file)
{
    const std::optional<Json> parsed = Json::parse(text);
    if (!parsed)
        return Error{Issue::json_syntax, file, "", ""};
    const Json& json = *parsed;
    const Error no_plan{Issue::internal, file, "", "is not a plan of this version"};
    // the JSON reader throws where a member is missing or of another type
    try
    {
        Graph graph;
        if (json.at("schema") != kPlanSchema)
            return no_plan;
        json.at("sources").get_to(graph.source_count);
        for (const Json& action : json.at("actions"))
            graph.actions.push_back(parseAction(action));
        return isConsistent(graph) ? Result<Graph>(std::move(graph)) : no_plan;
    }
    catch (const JsonError&)
    {
        return no_plan;
    }
}

} // namespace hearth::graph
