#include "tests/service/observe/exposition.h"

#include <cmath>
#include <limits>
#include <regex>
#include <set>
#include <sstream>

namespace gaitmill {

namespace {

double parseNumber(const std::string& text) {
  if (text == "+Inf" || text == "-Inf") {
    return text[0] == '+' ? std::numeric_limits<double>::infinity()
                          : -std::numeric_limits<double>::infinity();
  }
  std::size_t used = 0;
  try {
    const double value = std::stod(text, &used);
    return used == text.size() ? value : std::nan("");
  } catch (const std::exception&) {
    return std::nan("");
  }
}

class Reader {
 public:
  Exposition read(const std::string& text) {
    if (text.empty() || text.back() != '\n') {
      fault("the text ends in a line feed");
    }
    std::istringstream lines(text);
    while (std::getline(lines, line_)) {
      readLine();
    }
    endFamily();
    return std::move(result_);
  }

 private:
  void fault(const std::string& what) { result_.faults.push_back(what + ": " + line_); }

  void readLine() {
    static const std::regex help("# HELP ([a-zA-Z_:][a-zA-Z0-9_:]*) ((?:[^\\\\]|\\\\[\\\\n])*)");
    static const std::regex type(
        "# TYPE ([a-zA-Z_:][a-zA-Z0-9_:]*) (counter|gauge|histogram|summary|untyped)");
    static const std::regex sample(
        "([a-zA-Z_:][a-zA-Z0-9_:]*)"
        "(\\{(?:[a-zA-Z_][a-zA-Z0-9_]*=\"(?:[^\"\\\\]|\\\\[\\\\\"n])*\",?)*\\})? "
        "([^ ]+)");
    std::smatch match;
    if (std::regex_match(line_, match, help)) {
      endFamily();
      family_ = match[1];
      if (!families_.insert(family_).second) {
        fault("a metric is described twice");
      }
    } else if (std::regex_match(line_, match, type)) {
      if (match[1] != family_ || !result_.types.emplace(family_, match[2]).second) {
        fault("TYPE follows HELP, once");
      }
    } else if (std::regex_match(line_, match, sample)) {
      readSample(match[1], match[2], match[3]);
    } else {
      fault("no line of the format");
    }
  }

  void readSample(const std::string& name, const std::string& labels, const std::string& number) {
    const bool is_histogram = result_.types[family_] == "histogram";
    const std::string rest = name.compare(0, family_.size(), family_) == 0
                                 ? name.substr(family_.size())
                                 : std::string("other");
    const bool belongs =
        is_histogram ? rest == "_bucket" || rest == "_sum" || rest == "_count" : rest.empty();
    if (!belongs) {
      fault("the sample belongs to no metric that was described just before");
    }
    const double value = parseNumber(number);
    if (std::isnan(value) && number != "NaN") {
      fault("not a number");
    }
    if (!result_.samples.emplace(name + labels, value).second) {
      fault("the same sample twice");
    }
    if (is_histogram) {
      readHistogram(rest, value);
    }
  }

  void readHistogram(const std::string& part, double value) {
    if (part == "_bucket") {
      if (value < last_bucket_) {
        fault("buckets ascend");
      }
      last_bucket_ = value;
    } else if (part == "_count") {
      if (value != last_bucket_) {
        fault("the last bucket holds all");
      }
      last_bucket_ = 0;
    }
  }

  void endFamily() { last_bucket_ = 0; }

  Exposition result_;
  std::set<std::string> families_;
  std::string family_;
  std::string line_;
  double last_bucket_ = 0;
};

}  // namespace

Exposition parseExposition(const std::string& text) {
  return Reader().read(text);
}

}  // namespace gaitmill
