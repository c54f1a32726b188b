// Action graph of a cook: each action runs one cooker, which reads files and writes others.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace hearth::graph
{

inline constexpr size_t kNoAction = SIZE_MAX;

/// One word of a cooker's command line. Paths are left open: the executor chooses where files are.
struct Word
{
    enum class Kind : uint8_t
    {
        text,
        input,
        output,
    };
    Kind kind = Kind::text;
    std::string text; ///< the word; for a file the text before its path ("1=" of "1=rock_low.glb")
    size_t index = 0; ///< index of the input or output
};

/// Input of an action: an output of an earlier action, or a user file.
struct Input
{
    std::string role;          ///< role for the cooker: "source", "lod 1", "part of clusters"
    size_t action = kNoAction; ///< index of the action whose output it is
    std::string path;          ///< as the user typed it, for user files
    size_t output = 0;         ///< index of that output
};

/// Estimated resource use of an action. It affects the order of work only.
struct Estimate
{
    uint64_t memory_bytes = 0; ///< peak
    double seconds = 0;
};

struct Action
{
    std::string cooker;  ///< name without prefix: "import" is hearth-import
    size_t source = 0;   ///< index of the cook's source; source_count for actions that belong to no source
    std::string subject; ///< name of the output in messages: the source, or the pack
    std::vector<Word> words;
    std::vector<Input> inputs;
    /// File names, unique among the actions of one source. At least one; the first is the part.
    std::vector<std::string> outputs;
    bool is_lister = false; ///< its first output is a list that applyList reads
    /// Index of the action whose list names further inputs or words of this one, which applyList adds once
    /// the list is known; kNoAction: none
    size_t lister = kNoAction;
    bool finds_files = false; ///< reads files that are not declared inputs, and lists them with --depfile
    bool depends_on_processor = false; ///< output bytes are equal only on processors of one class
    Estimate estimate;
};

/// Directed acyclic graph of actions. Each action comes after the actions that it reads from; the last one
/// makes the pack.
struct Graph
{
    std::vector<Action> actions;
    size_t source_count = 0;
};

/// Paths of one action's files, in the order of its inputs and outputs.
struct ActionPaths
{
    std::vector<std::string> inputs;
    std::vector<std::string> outputs;
};

/// Return the command line of an action, with the cooker in folder `programs`.
std::vector<std::string> commandLine(const Action& action, const std::string& programs,
                                     const ActionPaths& paths);

} // namespace hearth::graph
