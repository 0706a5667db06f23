// Hostile inputs near the limits through reading, mending and landmarks, and what is a body through
// the whole fit: each in a process of its own, with its time, its memory and what came out, as a
// table for docs/mesh_repair.md.
//
//   hostile_inputs [PART_OF_A_NAME]     fails where one takes too long, too much, or crashes
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <span>
#include <string>

#include "core/base/status.h"
#include "core/body/find_body.h"
#include "core/formats/read_mesh.h"
#include "core/mesh/prepare_mesh.h"
#include "core/pipeline/fit.h"
#include "tests/bench/hostile_cases.h"

namespace capfit::bench {
namespace {

// What no input of the accepted size may take, on one core.
constexpr double kMostSeconds = 10.0;
constexpr double kMostMegabytes = 1000.0;

double Seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// A field of /proc/self/status, in megabytes.
double MegabytesOf(const std::string& field) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind(field, 0) == 0)
      return std::strtod(line.c_str() + field.size() + 1, nullptr) / 1024;
  }
  return 0.0;
}

std::string OutcomeOf(const absl::Status& status) {
  const auto reason = ReasonOf(status);
  const std::string name =
      reason ? std::string(ErrorReasonName(*reason)) : absl::StatusCodeToString(status.code());
  return name + ": " + std::string(status.message()).substr(0, 110);
}

struct Measured {
  double read_s = 0.0;
  double prepare_s = 0.0;
  double find_s = 0.0;
  double fit_s = 0.0;  // from the mesh on, once more
  double faces = 0.0;
  std::string outcome;
};

Measured Measure(HostileInput& input) {
  Measured measured;
  double start = Seconds();
  if (!input.bytes.empty()) {
    auto soup = formats::ReadMesh(std::as_bytes(std::span(input.bytes)), input.format);
    measured.read_s = Seconds() - start;
    if (!soup.ok()) {
      measured.outcome = OutcomeOf(soup.status());
      return measured;
    }
    input.soup = *std::move(soup);
    start = Seconds();
  }
  const formats::PolygonSoup& soup = input.soup;
  measured.faces = static_cast<double>(soup.face_sizes.empty() ? soup.face_vertices.size() / 3
                                                               : soup.face_sizes.size());
  const auto prepared = mesh::PrepareMesh(soup);
  measured.prepare_s = Seconds() - start;
  if (!prepared.ok()) {
    measured.outcome = OutcomeOf(prepared.status());
    return measured;
  }
  for (const Warning& warning : prepared->warnings) measured.outcome += warning.code + " ";
  start = Seconds();
  const ThreadPool pool(1);
  body::BodyOptions options;
  options.skeleton = soup.joints;
  const auto body = body::FindBody(prepared->mesh, options, pool, NullObserver());
  measured.find_s = Seconds() - start;
  measured.outcome += body.ok() ? "body" : OutcomeOf(body.status());
  if (!body.ok()) return measured;
  start = Seconds();
  NullObserver observer;
  const auto fit = pipeline::Fit(soup, {}, pool, observer);
  measured.fit_s = Seconds() - start;
  if (!fit.ok()) measured.outcome = OutcomeOf(fit.status());
  return measured;
}

// Exit code 0 where it stays within bounds.
int RunInThisProcess(const HostileCase& tested) {
  HostileInput input = tested.make();
  const double before = MegabytesOf("VmRSS:");
  std::ofstream("/proc/self/clear_refs") << "5";  // the peak counts from here
  const Measured measured = Measure(input);
  const double megabytes = MegabytesOf("VmHWM:") - before;
  const double seconds = measured.read_s + measured.prepare_s + measured.find_s + measured.fit_s;
  const double size_mb = static_cast<double>(input.bytes.size()) / 1048576.0;
  std::printf("| %s | %.2f | %.0f | %.2f | %.2f | %.2f | %.2f | %.0f | %s |\n", tested.name,
              1e-6 * measured.faces, size_mb, measured.read_s, measured.prepare_s, measured.find_s,
              measured.fit_s, megabytes, measured.outcome.c_str());
  std::fflush(stdout);
  return seconds <= kMostSeconds && megabytes <= kMostMegabytes ? 0 : 1;
}

bool Run(const HostileCase& tested) {
  const pid_t child = fork();
  if (child == 0) {
    alarm(300);
    _exit(RunInThisProcess(tested));
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFSIGNALED(status))
    std::printf("| %s | killed by signal %d |\n", tested.name, WTERMSIG(status));
  std::fflush(stdout);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

int Main(const char* wanted) {
  std::vector<HostileCase> cases = HostileArrays();
  for (HostileCase& file : HostileFiles()) cases.push_back(std::move(file));
  int bad = 0;
  std::printf(
      "| input | million faces | file MB | read s | mend s | landmarks s | fit s | peak MB | "
      "outcome |\n"
      "|---|---|---|---|---|---|---|---|---|\n");
  std::fflush(stdout);
  for (const HostileCase& tested : cases) {
    if (std::strstr(tested.name, wanted) != nullptr) bad += Run(tested) ? 0 : 1;
  }
  std::printf("%d beyond %.0f s or %.0f MB\n", bad, kMostSeconds, kMostMegabytes);
  return bad == 0 ? 0 : 1;
}

}  // namespace
}  // namespace capfit::bench

int main(int argc, char** argv) { return capfit::bench::Main(argc > 1 ? argv[1] : ""); }
