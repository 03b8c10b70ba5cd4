#include <fmt/format.h>

#include <memory>

#include "cli/commands.h"
#include "cli/json_option.h"
#include "cli/number_option.h"
#include "cli/progress_line.h"
#include "cli/result_folder.h"
#include "cli/terminal.h"
#include "core/base/errors.h"
#include "runs/example/example_files.h"

namespace dwell::cli {
namespace {

struct ExampleArguments {
  std::string out, shape = "round";
  ExampleOptions mirror;
  ExampleTifOptions tif;
  JsonOption json;
  ResultFolder folder;
};

int run_example(ExampleArguments& arguments, const CLI::App& command) {
  if (arguments.shape == "round" && command.count("--height") > 0) {
    throw InputError(fmt::format(
        "--height {}: of a rectangle only; a round mirror has its diameter by --width (or give --shape rectangle)",
        arguments.mirror.height));
  }
  arguments.mirror.shape = arguments.shape == "round" ? ExampleOptions::Shape::Round : ExampleOptions::Shape::Rectangle;
  arguments.json.check({}, arguments.out);
  OutputFolder folder = arguments.folder.make(arguments.out, example_files(), {});
  const Progress progress = terminal_progress();
  const Example example = write_example(folder.path(""), arguments.mirror, arguments.tif, progress);
  finish_progress();
  folder.commit();
  arguments.json.deliver(
      example_json(example, arguments.mirror.seed),
      fmt::format("written   {0}/mirror.csv, {0}/tif.csv, {0}/demo.toml, {0}/MANIFEST\n", arguments.out));
  return kDone;
}

}  // namespace

void add_example_command(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("example", "make an example mirror, removal function and job file");
  auto arguments = std::make_shared<ExampleArguments>();
  ExampleOptions& m = arguments->mirror;
  command
      ->add_option("--out", arguments->out,
                   "where the files are written; replaced whole if it holds an earlier example")
      ->type_name("FOLDER")
      ->required();
  command->add_option("--shape", arguments->shape, "round or rectangle (default round)")
      ->check(CLI::IsMember({"round", "rectangle"}));
  const auto length = [command](const char* flag, double& into, const ValueRange& range, const std::string& help) {
    add_number(*command, flag, into, range, help)->type_name("MM");
  };
  length("--width", m.width, ranges::kSize, fmt::format("width along x or diameter in mm (default {})", m.width));
  length("--height", m.height, ranges::kSize,
         fmt::format("height along y in mm, rectangle only (default {})", m.height));
  length("--hole", m.hole, ranges::kLength, "diameter of a central hole in mm, round only (default 0)");
  length("--pitch", m.pitch, ranges::kPitch, fmt::format("pixel pitch in mm (default {})", m.pitch));
  add_whole_number(*command, "--seed", m.seed, fmt::format("seed of the roughness and the noise (default {})", m.seed))
      ->type_name("N");
  arguments->folder.add_to(*command);
  arguments->json.add_to(*command);
  command->footer("Example:\n  dwell example --out example\n  dwell plan --job example/demo.toml --out plan");
  command->callback([arguments, command, &exit_code] { exit_code = run_example(*arguments, *command); });
}

}  // namespace dwell::cli
