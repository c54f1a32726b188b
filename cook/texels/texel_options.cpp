// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/texel_options.h"

namespace hearth::texels
{

void addTexelOptions(cli::CommandLine& app, TexelArguments& arguments)
{
    app.addOption("import", arguments.import_part, "import part: its materials tell what images are for")
        .required();
    app.addOption("textures", arguments.textures_part, "textures part").required();
    app.addOption("-j,--jobs", arguments.jobs, "threads to use; the result does not depend on it");
    app.addOption(
        "--family", arguments.families,
        "formats that the target reads: astc, astc-hdr, etc2 or bc; may be repeated. Default: astc and "
        "etc2");
    app.addOption("--quality", arguments.quality,
                  "target of error, and effort: draft 34 dB, normal 39, high 43 for colours")
        .choices({effortNames().begin(), effortNames().end()}, "QUALITY");
    app.addFlag("--strict", arguments.strict, "do not compress an image that misses its target");
    app.addOption("--set", arguments.rules,
                  "KEY=VALUE: rules by role or name, as textures.role=[{role=\"normal\",target=2}] or "
                  "textures.image=[{name=\"ui_*\",format=\"plain\"}]")
        .oneValueEach();
}

Result<TexelOptions> parseTexelOptions(const TexelArguments& arguments)
{
    TexelOptions options{.strict = arguments.strict};
    if (arguments.families.empty())
        options.families = {.astc = true, .etc2 = true};
    for (const std::string& name : arguments.families)
        if (!addFamily(name, options.families))
            return Error{Issue::usage, arguments.import_part, "--family",
                         "\"" + name + "\" is none of astc, etc2, bc"};
    options.quality = *parseEffort(arguments.quality);
    std::string rules;
    for (const std::string& rule : arguments.rules)
        rules += rule + "\n";
    HEARTH_ASSIGN_OR_RETURN(options.rules, parseTextureRules(rules, "--set"));
    for (const NameRule& rule : options.rules.images)
        if (!rule.path.empty())
            return Error{Issue::usage, arguments.import_part, "--set",
                         "a rule by path needs hearth cook, which knows where sources lie"};
    return options;
}

std::string inputName(const TexelArguments& arguments)
{
    return arguments.import_part.substr(arguments.import_part.rfind('/') + 1); // npos + 1 is 0
}

} // namespace hearth::texels
