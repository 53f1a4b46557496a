// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <bit>
#include <cstdint>
#include <map>
#include <set>

#include <fmt/format.h>

#include "reports/check_report.h"
#include "reports/check_words.h"
#include "reports/figures_json.h"

namespace plumbline::reports {
namespace {

/// Where the mesh lies: readers of SARIF open it.
const std::string& path_of(const verdict::CheckedMesh& mesh) {
  return mesh.path.empty() ? mesh.file : mesh.path;
}

using oracle::FindingCode;
using verdict::CheckFinding;
using verdict::CheckVerdict;

std::string rule_id(FindingCode code) { return fmt::format("PL{}", static_cast<int>(code)); }

/// FNV-1a, 64 bits (Fowler, Noll, Vo): the same on every machine.
class Fingerprint {
 public:
  void add(std::string_view bytes) {
    for (const char c : bytes) {
      hash_ ^= static_cast<unsigned char>(c);
      hash_ *= 0x100000001b3ULL;
    }
    hash_ *= 0x100000001b3ULL;  // an end: "ab", "c" is not "a", "bc"
  }
  void add(double value) { add(fmt::format("{:016x}", std::bit_cast<std::uint64_t>(value))); }
  [[nodiscard]] std::string text() const { return fmt::format("{:016x}", hash_); }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

/// The first sentence: up to a full stop before a blank.
std::string first_sentence(std::string_view text) {
  const std::size_t end = text.find(". ");
  return std::string(end == std::string_view::npos ? text : text.substr(0, end + 1));
}

/// A relative reference, or file:///… of an absolute path (RFC 3986, 8089): every byte but unreserved ones
/// and '/' becomes %XX, so also a colon that would make a scheme.
std::string file_uri(std::string_view path) {
  std::string out = path.starts_with('/') ? "file://" : "";
  for (const char c : path) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '-' || c == '.' || c == '_' || c == '~' || c == '/';
    if (plain) {
      out += c;
    } else {
      out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
  }
  return out;
}

/// No helpUri: it must be absolute, and the manual lies beside the program. A relative one makes uploads
/// fail.
Json rule_json(FindingCode code, bool hazard) {
  const std::string name = code_name(code), link = code_link(code);
  const std::string definition =
      code_definition(code).empty() ? counted_code(code, 1) : std::string(code_definition(code));
  Json out = {{"id", rule_id(code)},
              {"name", name},
              {"shortDescription", {{"text", first_sentence(definition)}}},
              {"fullDescription", {{"text", definition}}},
              {"defaultConfiguration", {{"level", hazard ? "warning" : "error"}}}};
  const std::string remedy(code_remedy(code));
  std::string plain = remedy.empty() ? definition : remedy, marked = plain;
  if (!link.empty()) {
    plain += fmt::format(" See {}.", link);
    marked += fmt::format(" See [{} {}]({}).", static_cast<int>(code), name, link);
  }
  out["help"] = {{"text", plain}, {"markdown", marked}};
  if (!link.empty()) out["properties"] = {{"manual", link}};
  return out;
}

/// Codes that a mesh may have and stay sound, until a finding says otherwise.
bool usually_hazard(FindingCode code) {
  return code == FindingCode::unused_vertex || code == FindingCode::t_junction || code == FindingCode::sliver;
}

/// Rules in the order of the codes: all of the catalogue, and whatever else occurs.
std::vector<FindingCode> rule_codes(const CheckVerdict& verdict) {
  std::set<int> numbers;
  for (const oracle::FindingDescription& entry : oracle::finding_catalogue())
    numbers.insert(static_cast<int>(entry.code));
  for (const CheckFinding& finding : verdict.findings) numbers.insert(static_cast<int>(finding.finding.code));
  std::vector<FindingCode> out;
  for (const int number : numbers) out.push_back(static_cast<FindingCode>(number));
  return out;
}

Json location_json(const std::string& file, Vec3 at) {
  const std::string place = place_words(at);
  // A mesh has no lines, but code scanning shows no result without one.
  return {
      {"physicalLocation", {{"artifactLocation", {{"uri", file_uri(file)}}}, {"region", {{"startLine", 1}}}}},
      {"logicalLocations", Json::array({{{"name", place},
                                         {"fullyQualifiedName", fmt::format("{} at {}", file, place)},
                                         {"kind", "position"}}})},
      {"properties", {{"at", xyz(at)}}}};
}

Json result_json(const CheckVerdict& verdict, const CheckFinding& finding, std::size_t rule,
                 std::map<std::string, int>& seen) {
  const oracle::Finding& plain = finding.finding;
  const bool named = finding.mesh < verdict.meshes.size();
  const bool paired = finding.other_mesh < verdict.meshes.size();
  const std::string file = named ? path_of(verdict.meshes[finding.mesh])
                           : finding.file.empty() && !verdict.meshes.empty() ? path_of(verdict.meshes.front())
                                                                             : finding.file;
  const std::string other_file = paired ? path_of(verdict.meshes[finding.other_mesh]) : std::string();
  std::string text = fmt::format("{} At {}", message_words(finding), place_words(finding.at));
  if (paired)
    text += fmt::format(", between {} and {}", mesh_name(verdict, finding.mesh),
                        mesh_name(verdict, finding.other_mesh));
  Json out = {{"ruleId", rule_id(plain.code)},
              {"ruleIndex", rule},
              {"level", plain.severity == oracle::Severity::hazard ? "warning" : "error"},
              {"message", {{"text", text + "."}}},
              // Code scanning refuses a whole upload for one result without a location.
              {"locations", Json::array({location_json(file, finding.at)})}};
  if (paired) {
    Json other = location_json(other_file, finding.at);
    other["id"] = 1;
    other["message"] = {{"text", "the other mesh"}};
    out["relatedLocations"] = Json::array({std::move(other)});
  }
  Fingerprint print;
  print.add(rule_id(plain.code));
  print.add(plain.kind);
  print.add(file);
  print.add(other_file);
  for (const double coordinate : {finding.at.x, finding.at.y, finding.at.z}) print.add(coordinate);
  const int copy = seen[print.text()]++;  // several findings of one kind at one place stay several
  out["partialFingerprints"] = {{"plumblineFinding/v1", fmt::format("{}:{}", print.text(), copy)}};
  Json properties = finding_json(plain);
  for (const char* told : {"code", "name", "severity", "at"}) properties.erase(told);
  properties["at"] = xyz(finding.at);
  out["properties"] = std::move(properties);
  return out;
}

}  // namespace

std::string check_sarif(const CheckVerdict& verdict) {
  const std::vector<FindingCode> codes = rule_codes(verdict);
  Json rules = Json::array();
  for (const FindingCode code : codes) rules.push_back(rule_json(code, usually_hazard(code)));
  Json artifacts = Json::array();  // each once, in the order of the meshes
  std::set<std::string> uris;
  for (const verdict::CheckedMesh& mesh : verdict.meshes) {
    const std::string uri = file_uri(path_of(mesh));
    if (uris.insert(uri).second) artifacts.push_back({{"location", {{"uri", uri}}}});
  }
  Json results = Json::array();
  std::map<std::string, int> seen;
  for (const CheckFinding& finding : verdict.findings) {
    const auto rule = std::ranges::find(codes, finding.finding.code) - codes.begin();
    results.push_back(result_json(verdict, finding, static_cast<std::size_t>(rule), seen));
  }
  const std::size_t total = std::max(verdict.findings_total, verdict.findings.size());
  Json run = {{"tool",
               {{"driver",
                 {{"name", "plumbline"},
                  {"version", PLUMBLINE_VERSION},
                  {"semanticVersion", PLUMBLINE_VERSION},
                  {"rules", std::move(rules)}}}}},
              {"invocations", Json::array({{{"executionSuccessful", true}}})},
              {"artifacts", std::move(artifacts)},
              {"results", std::move(results)},
              {"properties",
               {{"verdict", verdict.sound ? "sound" : "faulty"},
                {"headline", headline_words(verdict)},
                {"findings_total", total},
                {"notes", verdict.notes}}}};
  const Json out = {{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                    {"version", "2.1.0"},
                    {"runs", Json::array({std::move(run)})}};
  return json_text(out, 4);
}

}  // namespace plumbline::reports
