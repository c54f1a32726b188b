// Cooks a source, writes the pack as glTF, and cooks that again.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "tests/support/sandbox.h"

#include <memory>
#include <string>
#include <vector>

namespace hearth::test
{

/// The two packs of a way to glTF and back, and the file between them, in a folder of its own.
class RoundTrip
{
public:
    /// source          path of a file
    /// options         of both cooks
    /// second_options  of the second cook, instead
    RoundTrip(const std::string& source, const std::vector<std::string>& options)
        : RoundTrip(source, options, options)
    {
    }
    RoundTrip(const std::string& source, const std::vector<std::string>& options,
              const std::vector<std::string>& second_options);

    /// Return the message of the step that failed; empty: none has.
    const std::string& fault() const { return fault_; }

    const formats::PackView& first() const { return *first_; }
    const formats::PackView& second() const { return *second_; }
    std::string glbPath() const { return folder_ / "cut.glb"; }
    std::string firstPath() const { return folder_ / "first.hearth"; }
    std::string secondPath() const { return folder_ / "second.hearth"; }
    /// Text that hearth extract printed.
    const std::string& printed() const { return printed_; }

private:
    bool run(const std::vector<std::string>& command);
    std::unique_ptr<formats::PackView> open(const std::string& path);

    Sandbox folder_;
    std::string fault_;
    std::string printed_;
    std::unique_ptr<formats::PackView> first_;
    std::unique_ptr<formats::PackView> second_;
};

/// Options of a cook without light whose texels have the formats of some families, as "\"astc\"".
std::vector<std::string> makeOptions(const std::string& families);

/// The same with the texels of the source.
inline std::vector<std::string> plainTexels()
{
    return makeOptions("");
}

} // namespace hearth::test
