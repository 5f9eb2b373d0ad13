#include "shell_documents.hpp"

#include "arguments.hpp"
#include "support/temporary_folder.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <CLI/CLI.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>

namespace {

using test_support::TemporaryFolder;
using testing::HasSubstr;

class ShellDocuments : public testing::Test {
 protected:
  ShellDocuments() {
    CLI::App* build = root_.add_subcommand("build", "make a route's database");
    retrace::Arguments arguments(*build, true);
    arguments.positional("walk", walk_, "a video");
    arguments.option("-o,--output", output_, "a file [of 'routes': all]");
    arguments.settings(settings_, {place::SettingGroup::kMotion});
    arguments.exactly_one({arguments.option("--pairs", pairs_, "landmarks")});
    root_.add_subcommand("completion", "of words")
        ->add_option("shell", shell_, "which")
        ->check(CLI::IsMember({"bash", "zsh"}));
  }
  CLI::App root_{"about", "retrace"};
  std::string walk_, output_, pairs_, shell_;
  place::Settings settings_;
};

/// What a shell prints after reading a script.
std::string run_bash(const std::string& script) {
  const TemporaryFolder folder;
  const auto path = folder.write("script.sh", script);
  std::FILE* pipe = ::popen(("bash " + path.string() + " 2>&1").c_str(), "r");
  std::array<char, 4096> buffer{};
  std::string text;
  while (const std::size_t read = std::fread(buffer.data(), 1, buffer.size(), pipe))
    text.append(buffer.data(), read);
  EXPECT_EQ(::pclose(pipe), 0);
  return text;
}

TEST_F(ShellDocuments, BashCompletesCommandsFlagsAndChoices) {
  const std::string script = retrace::bash_completion(root_);
  const auto completed = [&](const std::string& words, int current) {
    return run_bash(script + "COMP_WORDS=(retrace " + words + ")\nCOMP_CWORD=" + std::to_string(current) +
                    "\n_retrace\necho \"${COMPREPLY[*]}\"\n");
  };
  EXPECT_EQ(completed("bu", 1), "build\n");
  EXPECT_EQ(completed("build --out", 2), "--output\n");
  EXPECT_EQ(completed("build --pa", 2), "--pairs\n");
  EXPECT_EQ(completed("build --motion st", 3), "steps\n");
  EXPECT_EQ(completed("completion ba", 2), "bash\n");
}

TEST_F(ShellDocuments, ZshNamesFlagsWithDescriptionsThatDoNotEndTheSpecification) {
  const std::string script = retrace::zsh_completion(root_);
  EXPECT_THAT(script, HasSubstr("#compdef retrace"));
  EXPECT_THAT(script, HasSubstr("'build:make a route s database'"));
  EXPECT_THAT(script, HasSubstr("'--output[a file \\[of  routes \\: all\\]]:value:_files'"));
  EXPECT_THAT(script, HasSubstr(":value:(auto sad steps"));
  EXPECT_THAT(script, HasSubstr("'*:file:(bash zsh)'"));
}

TEST_F(ShellDocuments, AManualPageListsArgumentsAndOptions) {
  const std::string page = retrace::manual_page(root_, "build");
  EXPECT_THAT(page, HasSubstr(".TH RETRACE\\-BUILD 1"));
  EXPECT_THAT(page, HasSubstr(".I walk\na video"));
  EXPECT_THAT(page, HasSubstr(".B \\-\\-every \\fIINT\\fR\nframes between keyframes"));
  EXPECT_THAT(page, HasSubstr("[1]"));
  EXPECT_THAT(page, HasSubstr(".SH NAME\nretrace\\-build \\- "));  // as `whatis` reads it
  EXPECT_THAT(retrace::manual_page(root_, ""), HasSubstr(".B build\nmake a route's database"));
  EXPECT_THROW_WITH(retrace::manual_page(root_, "biuld"), vo::Error, "biuld: is no command");
}

}  // namespace
