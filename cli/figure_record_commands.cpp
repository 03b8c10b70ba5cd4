#include <fmt/format.h>

#include <memory>
#include <string>

#include "cli/commands.h"
#include "cli/json_option.h"
#include "cli/progress_line.h"
#include "cli/terminal.h"
#include "core/base/counted.h"
#include "core/base/errors.h"
#include "runs/base/json_blocks.h"
#include "runs/figure/store/figure_state.h"
#include "runs/figure/store/run_folder.h"
#include "runs/figure/store/run_lock.h"
#include "runs/figure/store/run_status.h"
#include "runs/figure/store/step_json.h"
#include "runs/figure/store/withdrawn_step.h"

namespace dwell::cli {
namespace {

struct RecordArguments {
  std::string folder, why;
  int number = 0;
  JsonOption json;
};

int run_status(const RecordArguments& a) {
  a.json.check({}, a.folder);
  const RunFolder run(a.folder);
  a.json.deliver(json_text(status_json(run)), status_text(run));
  return kDone;
}

int run_check(const RecordArguments& a) {
  a.json.check({}, a.folder);
  const RunFolder run(a.folder);
  const std::vector<std::string> faults = run.faults();
  std::size_t files = 0;
  for (const RunStep& step : run.steps()) files += step.files.size() + 1;
  nlohmann::ordered_json json = json_of_command("figure check");
  json["run"] = run.folder().string();
  json["steps"] = run.steps().size();
  json["files"] = files;
  json["limits"] = faults;
  a.json.deliver(
      json_text(json),
      fmt::format("checked   {}: {} in {}, {}\n", a.folder, counted(files, "file"), counted(run.steps().size(), "step"),
                  faults.empty() ? "all as they were written" : counted(faults.size(), "fault")));
  return say_limits(faults);
}

int run_withdraw(const RecordArguments& a) {
  a.json.check({}, a.folder);
  RunFolder run(a.folder);
  const RunLock lock(a.folder);
  run = RunFolder(a.folder);
  const RunStep& step = withdraw_measurement(run, figure_state(run), a.number, a.why);
  a.json.deliver(json_text(step_json("figure withdraw", run, step)),
                 fmt::format("withdrawn step {}, which stays where it is; the run is as before it\n", a.number) +
                     status_text(run));
  return kDone;
}

std::shared_ptr<RecordArguments> add_run_argument(CLI::App& command) {
  auto a = std::make_shared<RecordArguments>();
  command.add_option("run", a->folder, "folder of the run")->type_name("RUN")->required();
  return a;
}

}  // namespace

void add_figure_record_commands(CLI::App& figure, int& exit_code) {
  CLI::App* status = figure.add_subcommand("status", "the table of a run, and what to do next");
  auto of_status = add_run_argument(*status);
  of_status->json.add_to(*status);
  status->footer("Example:\n  dwell figure status mirror/");
  status->callback([of_status, &exit_code] { exit_code = run_status(*of_status); });

  CLI::App* check = figure.add_subcommand("check", "whether every file of a run is as it was written");
  auto of_check = add_run_argument(*check);
  of_check->json.add_to(*check);
  check->footer("Example:\n  dwell figure check mirror/\nExit codes: 0 all as written, 3 a file is not.");
  check->callback([of_check, &exit_code] { exit_code = run_check(*of_check); });

  CLI::App* withdraw = figure.add_subcommand("withdraw", "take back a measurement; its step stays and is marked");
  auto of_withdraw = add_run_argument(*withdraw);
  withdraw->add_option("step", of_withdraw->number, "number of the step, as status shows it")
      ->type_name("N")
      ->required();
  withdraw->add_option("--why", of_withdraw->why, "why, for the record")->type_name("TEXT");
  of_withdraw->json.add_to(*withdraw);
  withdraw->footer("Example:\n  dwell figure withdraw mirror/ 3 --why 'measured upside down'");
  withdraw->callback([of_withdraw, &exit_code] { exit_code = run_withdraw(*of_withdraw); });
}

}  // namespace dwell::cli
