// vispline: read | verb | write. Errors end here, as an exit code and a text that says what to do next.
#include <iostream>
#include <new>
#include <stdexcept>

#include "console.h"
#include "exit_with.h"
#include "verbs.h"

namespace {

constexpr const char* kFooter =
    "Exit codes: 0 done, 2 usage, 3 input unreadable, 4 input unfit, 5 no trustworthy result, 6 output failed,\n"
    "            7 limit hit, 130/143 interrupted.\n"
    "Examples:\n"
    "  vispline demo --out out/demo\n"
    "  vispline simulate --trajectory dance --imu-rate 200 --noise course --out imu.csv\n"
    "  vispline simulate --trajectory mocap.csv --like imu.csv --out synth.csv\n"
    "  vispline allan static.csv --out out/allan --export kalibr,openvins\n"
    "  vispline evaluate synth.csv imu.csv\n"
    "  vispline export camchain.yaml --for orbslam3 --out orbslam3.yaml\n"
    "  vispline integrate --trajectory ellipse --imu-rate 50,100,200 --method all";

int run(int argc, char** argv) {
  CLI::App app("Simulate, identify, integrate and estimate with cameras and IMUs.", "vispline");
  app.set_version_flag("--version", "vispline " VISPLINE_VERSION);
  app.footer(kFooter);
  app.require_subcommand(0, 1);
  vispline::cli::add_simulate(app);
  vispline::cli::add_integrate(app);
  vispline::cli::add_allan(app);
  vispline::cli::add_evaluate(app);
  vispline::cli::add_calibrate(app);
  vispline::cli::add_estimate(app);
  vispline::cli::add_export(app);
  vispline::cli::add_info(app);
  vispline::cli::add_convert(app);
  vispline::cli::add_demo(app);
  try {
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) std::cout << app.help();
    return 0;
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    throw vispline::Error(vispline::ExitCode::kUsage, {.code = "E-USAGE",
                                                       .message = error.what(),
                                                       .where = "",
                                                       .effect = "nothing done",
                                                       .next = "run vispline --help or vispline VERB --help"});
  }
}

/// Nobody has the result if it did not reach stdout.
void check_stdout() {
  std::cout.flush();
  if (std::cout.good()) return;
  throw vispline::Error(vispline::ExitCode::kOutput, {.code = "E-OUTPUT",
                                                      .message = "cannot write to standard output",
                                                      .where = "",
                                                      .effect = "the printed result is not complete",
                                                      .next = "redirect to a place with room"});
}

int out_of_memory() {
  std::cerr << "error[E-LIMIT]: out of memory\n  effect: nothing written\n  next:   ask for fewer samples\n";
  return static_cast<int>(vispline::ExitCode::kLimit);
}

}  // namespace

int main(int argc, char** argv) {
  vispline::cli::catch_interrupts();
  try {
    const int exit_code = run(argc, argv);
    check_stdout();
    return exit_code;
  } catch (const vispline::Error& error) {
    std::cerr << error.what() << '\n';
    return static_cast<int>(error.exit_code());
  } catch (const vispline::cli::ExitWith& exit) {
    check_stdout();
    return exit.code;
  } catch (const vispline::cli::Interrupted& interrupted) {
    std::cerr << "error[E-INTERRUPTED]: stopped by signal " << interrupted.signal << "\n  effect: nothing written\n";
    return 128 + interrupted.signal;
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  } catch (const std::length_error&) {
    return out_of_memory();
  }
}
