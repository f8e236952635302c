#include "core/report/report_parts.h"

#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/analysis/quality_check.h"

namespace gaitmill {

namespace {

struct VerdictLook {
  const char* symbol;
  const char* word;
};

const std::map<std::string, VerdictLook>& verdictLooks() {
  static const std::map<std::string, VerdictLook> looks = {
      {"pass", {"\u2713", "pass"}}, {"warn", {"!", "warning"}}, {"fail", {"\u2717", "fail"}}};
  return looks;
}

struct StageTitle {
  const char* stage;
  const char* title;
};
constexpr StageTitle kStageTitles[] = {{"scale", "Scaling"},
                                       {"ik", "Inverse kinematics"},
                                       {"rra", "Residual reduction"},
                                       {"id", "Inverse dynamics"},
                                       {"so", "Static optimization"},
                                       {"cmc", "Computed muscle control"}};

std::string capitalize(std::string sentence) {
  if (!sentence.empty() && sentence[0] >= 'a' && sentence[0] <= 'z') {
    sentence[0] = static_cast<char>(sentence[0] - 'a' + 'A');
  }
  return sentence;
}

std::string countThings(std::size_t count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

/// How many checks have each verdict.
std::map<std::string, std::size_t> countVerdicts(const Json& summary) {
  std::map<std::string, std::size_t> counts;
  for (const Json& check : findMember(summary, {"quality", "checks"})) {
    ++counts[findWords(check, {"verdict"})];
  }
  return counts;
}

std::string explainVerdict(const Json& summary) {
  std::map<std::string, std::size_t> counts = countVerdicts(summary);
  const std::size_t all = counts["pass"] + counts["warn"] + counts["fail"];
  if (all == 0) {
    return "The stages that ran have nothing that could be judged.";
  }
  if (counts["fail"] > 0) {
    return "Do not build on this result yet: " + countThings(counts["fail"], "figure") + " of " +
           std::to_string(all) + " lie far beyond what the field accepts" +
           (counts["warn"] > 0 ? ", and " + std::to_string(counts["warn"]) +
                                     " more exceed their "
                                     "limit."
                               : ".");
  }
  if (counts["warn"] > 0) {
    return "Usable with care: " + countThings(counts["warn"], "figure") + " of " +
           std::to_string(all) +
           " exceed what the field recommends, none so far that the result should be discarded. "
           "Read below what each of them means for your question.";
  }
  return "All " + std::to_string(all) + " figures lie within what the field recommends.";
}

Html renderDefinitions(const std::vector<std::pair<std::string, Html>>& definitions) {
  Html list;
  for (const auto& [name, value] : definitions) {
    if (!value.empty()) {
      list += element("div", element("dt", name) + element("dd", value));
    }
  }
  return element("dl", list);
}

Html renderHash(const std::string& hash) {
  return hash.empty() ? Html() : element("code", hash);
}

Html renderInputs(const std::vector<ReportInput>& inputs) {
  HtmlTable table("Input files as uploaded",
                  {{"Part"}, {"File"}, {"Size in bytes", true}, {"SHA-256"}});
  for (const ReportInput& input : inputs) {
    table.addRow({text(input.part),
                  text(input.name),
                  text(std::to_string(input.size)),
                  renderHash(input.sha256)});
  }
  return table.empty() ? Html() : table.render();
}

std::string renderWithUnit(const Html& figure, const std::string& unit) {
  return figure.markup() +
         (unit.empty() ? "" : "\u00a0" + text(unit == "N.m" ? "N\u00b7m" : unit).markup());
}

Html renderLimit(const Json& check, const char* which) {
  const double limit = findNumber(check, {which});
  const std::string unit = findWords(check, {"unit"});
  if (std::isnan(limit)) {
    return text("never");
  }
  return unit.empty() ? text("must not be") : trusted(renderWithUnit(renderFigure(limit), unit));
}

Html renderValue(const Json& check) {
  const std::string unit = findWords(check, {"unit"});
  const std::string worst = findWords(check, {"worst"});
  if (unit.empty()) {
    return text(findNumber(check, {"value"}) > 0 ? "so" : "not so");
  }
  Html value = trusted(renderWithUnit(renderFigure(findNumber(check, {"value"})), unit));
  return worst.empty() ? value
                       : value + text(" ") + element("span", {{"class", "who"}}, text(worst));
}

Html renderLabelled(const char* label, const std::string& words) {
  return words.empty() ? Html()
                       : element("p", element("strong", std::string(label)) + text(" " + words));
}

Html renderSource(const Json& check) {
  const std::string fail_source = findWords(check, {"fail_source"});
  Html source = text(findWords(check, {"source"}));
  if (!fail_source.empty()) {
    source += element("small", "Fails: " + fail_source);
  }
  return source;
}

/// A cell that names its column where columns no longer stand below each other.
Html makeCell(const char* column, const Html& content, bool is_number = false) {
  return element("td", {{"data-column", column}, {"class", is_number ? "number" : ""}}, content);
}

Html renderCheck(const Json& check) {
  const std::string verdict = findWords(check, {"verdict"});
  Html rows = element(
      "tr",
      element("th",
              {{"scope", "row"}},
              renderVerdict(verdict) + text(" " + capitalize(findWords(check, {"meaning"})))) +
          makeCell("Value", renderValue(check), true) +
          makeCell("Limit", renderLimit(check, "limit"), true) +
          makeCell("Fails above", renderLimit(check, "fail_above"), true) +
          makeCell("Source", renderSource(check)));
  const Html advice = renderLabelled("Likely cause:", findWords(check, {"cause"})) +
                      renderLabelled("What to do:", findWords(check, {"fix"}));
  if (!advice.empty()) {
    rows +=
        element("tr", {{"class", "advice " + verdict}}, element("td", {{"colspan", "5"}}, advice));
  }
  return rows;
}

Html renderChecks(const std::string& stage, const Json& summary) {
  Html rows;
  for (const Json& check : findMember(summary, {"quality", "checks"})) {
    if (findWords(check, {"stage"}) == stage) {
      rows += renderCheck(check) + trusted("\n");
    }
  }
  if (rows.empty()) {
    return {};
  }
  Html head;
  for (const char* column : {"Check", "Value", "Limit", "Fails above", "Source of the limit"}) {
    head += element("th", {{"scope", "col"}}, text(column));
  }
  return element("table",
                 {{"class", "checks"}},
                 element("caption", "Checks of " + stageTitle(stage)) +
                     element("thead", element("tr", head)) + element("tbody", rows));
}

}  // namespace

Html renderVerdict(const std::string& verdict) {
  const auto known = verdictLooks().find(verdict);
  if (known == verdictLooks().end()) {
    return {};
  }
  return element("span",
                 {{"class", "verdict " + verdict}},
                 element("span", {{"aria-hidden", "true"}}, text(known->second.symbol)) +
                     text(std::string("\u00a0") + known->second.word));
}

Html renderFigure(double value, double scale) {
  return text(std::isfinite(value) ? formatFigure(value * scale) : "\u2013");
}

std::string stageTitle(const std::string& stage) {
  for (const StageTitle& known : kStageTitles) {
    if (stage == known.stage) {
      return known.title;
    }
  }
  return stage;
}

Html renderHeader(const ReportProvenance& provenance, const Json& summary) {
  const std::string verdict = findWords(summary, {"verdict"});
  std::string of = provenance.subject;
  of += of.empty() || provenance.label.empty() ? provenance.label : ", " + provenance.label;
  const Html title = element("h1", "How far to trust this gait analysis") +
                     (of.empty() ? Html() : element("p", {{"class", "subject"}}, text(of)));
  return element("header",
                 title + element("p",
                                 {{"class", "overall " + verdict}},
                                 renderVerdict(verdict) + text(" " + explainVerdict(summary))));
}

Html renderOverview(const Json& summary) {
  const Json& stages = findMember(summary, {"quality", "stages"});
  HtmlTable table("Verdict of each stage",
                  {{"Stage"}, {"Verdict"}, {"Checks", true}, {"What exceeds its limit"}});
  for (const auto& [stage, judged] : stages.items()) {
    Html reasons;
    for (const Json& reason : findMember(judged, {"reasons"})) {
      reasons += element("li", capitalize(reason.get<std::string>()));
    }
    table.addRow({element("a", {{"href", "#" + stage}}, text(stageTitle(stage))),
                  renderVerdict(findWords(judged, {"verdict"})),
                  text(std::to_string(findMember(judged, {"checks"}).size())),
                  reasons.empty() ? text("nothing") : element("ul", reasons)});
  }
  return table.empty() ? Html() : element("section", element("h2", "Overview") + table.render());
}

Html renderProvenance(const ReportProvenance& provenance, const Json& summary) {
  const auto figure = [&](const char* name, const char* unit) {
    const double value = findNumber(summary, {"subject", name});
    return std::isnan(value) ? Html() : renderFigure(value) + text(std::string("\u00a0") + unit);
  };
  Html section =
      element("h2", "Where these numbers come from") +
      renderDefinitions({{"Job", renderHash(provenance.job_id)},
                         {"Subject", text(provenance.subject)},
                         {"Label", text(provenance.label)},
                         {"Body mass", figure("mass_kg", "kg")},
                         {"Body height", figure("height_m", "m")},
                         {"Submitted", text(provenance.created_at)},
                         {"Finished", text(provenance.finished_at)},
                         {"Model", text(provenance.model)},
                         {"Settings", text(provenance.settings_name)},
                         {"Version", text(provenance.version)},
                         {"Provenance", renderHash(provenance.provenance)}}) +
      element("p",
              "The provenance is a hash over all inputs, the model, every setting and the code: "
              "jobs of the same provenance have the same results to the last bit.") +
      renderInputs(provenance.inputs);
  const Json& settings = findMember(summary, {"settings_used"});
  if (!settings.is_null()) {
    section += element("details",
                       element("summary", "Every setting used") + element("pre", settings.dump(1)));
  }
  return element("section", {{"id", "provenance"}}, section);
}

Html renderPoses(const std::vector<ReportImage>& images) {
  Html poses;
  for (const ReportImage& image : images) {
    const Html picture = voidElement("img",
                                     {{"src", makeDataUri(image.content_type, image.bytes)},
                                      {"alt", "The model's pose at: " + image.caption}});
    poses += element("figure", picture + element("figcaption", image.caption));
  }
  if (poses.empty()) {
    return {};
  }
  return element("section",
                 element("h2", "The movement") + element("div", {{"class", "poses"}}, poses));
}

Html renderStage(const std::string& stage, const Json& summary) {
  const Html content = renderChecks(stage, summary) + renderStageTables(stage, summary);
  if (content.empty()) {
    return {};
  }
  const std::string verdict = findWords(summary, {"quality", "stages", stage, "verdict"});
  return element("section",
                 {{"id", stage}},
                 element("h2", text(stageTitle(stage) + " ") + renderVerdict(verdict)) + content);
}

Html renderWarnings(const Json& summary) {
  Html items;
  for (const Json& warning : findMember(summary, {"warnings"})) {
    items += element("li", warning.get<std::string>());
  }
  return items.empty()
             ? Html()
             : element("section", element("h2", "What the stages remarked") + element("ul", items));
}

Html renderFooter(const ReportProvenance& provenance) {
  constexpr const char* kCitations[] = {
      "Rajagopal A, Dembia CL, DeMers MS, Delp DD, Hicks JL, Delp SL. Full-body musculoskeletal "
      "model for muscle-driven simulation of human gait. IEEE Trans Biomed Eng 63:2068\u20132079, "
      "2016.",
      "Hicks JL, Uchida TK, Seth A, Rajagopal A, Delp SL. Is my model good enough? Best practices "
      "for verification and validation of musculoskeletal models and simulations of movement. "
      "J Biomech Eng 137:020905, 2015.",
      "Seth A, Hicks JL, Uchida TK, et al. OpenSim: simulating musculoskeletal dynamics and "
      "neuromuscular control to study human and animal movement. PLoS Comput Biol 14:e1006223, "
      "2018.",
      "Zajac FE. Muscle and tendon: properties, models, scaling, and application to biomechanics "
      "and motor control. Crit Rev Biomed Eng 17:359\u2013411, 1989.",
      "\u201cOpenSim checklist\u201d: the list of questions for evaluating a simulation in the "
      "OpenSim documentation, Simulation with OpenSim \u2013 Best Practices."};
  Html citations;
  for (const char* const citation : kCitations) {
    citations += element("li", std::string(citation));
  }
  return element(
      "footer",
      element("h2", "Sources of the limits") + element("ul", citations) +
          element("p",
                  "A figure beyond its limit is a warning; beyond the second bound the "
                  "result should not be used. Limits named \u201cgaitmill\u201d are this "
                  "program\u2019s own, because the literature states none.") +
          element("p", "Made by gaitmill " + provenance.version + "."));
}

}  // namespace gaitmill
