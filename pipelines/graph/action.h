// A cook as data: actions that each run one cooker over files and make others.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace hearth::graph
{

inline constexpr size_t kNoAction = SIZE_MAX;

/// One word of a cooker's command line. Paths are left open: an executor chooses where files lie.
struct Word
{
    enum class Kind : uint8_t
    {
        text,
        input,
        output,
    };
    Kind kind = Kind::text;
    std::string text; ///< the word; for a file what stands before its path ("1=" of "1=rock_low.glb")
    size_t index = 0; ///< of the input or output
};

/// A file that an action reads: what an action before it makes, or a file of the user.
struct Input
{
    std::string role;          ///< what it is to the cooker: "source", "lod 1", "part of clusters"
    size_t action = kNoAction; ///< whose first output it is
    std::string path;          ///< as the user typed it, where no action makes it
};

/// What an action is thought to need; only the order of work depends on it.
struct Estimate
{
    uint64_t memory_bytes = 0; ///< peak
    double seconds = 0;
};

struct Action
{
    std::string cooker;  ///< "import" is hearth-import
    size_t source = 0;   ///< index of the cook's source; their number for what is not of one
    std::string subject; ///< what messages call its output: the source, or the pack
    std::vector<Word> words;
    std::vector<Input> inputs;
    /// Names of files: no two alike among the actions of one source. At least one; the first is what others read.
    std::vector<std::string> outputs;
    bool finds_files = false;          ///< reads files that only it can name, and lists them with --depfile
    bool depends_on_processor = false; ///< its bytes are the same on processors of one class only
    Estimate estimate;
};

/// Each action stands after those that it reads from; the last one makes the pack.
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

/// The command line, its cooker in folder `programs`.
std::vector<std::string> commandOf(const Action& action, const std::string& programs,
                                   const ActionPaths& paths);

} // namespace hearth::graph
