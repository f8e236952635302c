#include "core/data/expression.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <map>

#include "core/base/error.h"

namespace gaitmill {

namespace {

constexpr std::size_t kMaximumLength = 2000;
constexpr int kMaximumDepth = 32;
constexpr int kMaximumStack = 64;
// Definitions that use each other twice would double with every one.
constexpr std::size_t kMaximumSteps = 4000;

using Apply = double (*)(const double*);

struct Operation {
  const char* name;
  int arguments;
  Apply apply;
};

double calcStep(double x) {
  return x >= 0 ? 1.0 : 0.0;
}

constexpr int kAdd = 0, kSubtract = 1, kMultiply = 2, kDivide = 3, kPower = 4, kNegate = 5;
constexpr int kFirstFunction = 6;
constexpr int kNumber = -1, kVariable = -2;

constexpr std::array<Operation, 33> kOperations = {{
    {"+",
     2,
     [](const double* x) {
       return x[0] + x[1];
     }},
    {"-",
     2,
     [](const double* x) {
       return x[0] - x[1];
     }},
    {"*",
     2,
     [](const double* x) {
       return x[0] * x[1];
     }},
    {"/",
     2,
     [](const double* x) {
       return x[0] / x[1];
     }},
    {"^",
     2,
     [](const double* x) {
       return std::pow(x[0], x[1]);
     }},
    {"negate",
     1,
     [](const double* x) {
       return -x[0];
     }},
    {"sqrt",
     1,
     [](const double* x) {
       return std::sqrt(x[0]);
     }},
    {"exp",
     1,
     [](const double* x) {
       return std::exp(x[0]);
     }},
    {"log",
     1,
     [](const double* x) {
       return std::log(x[0]);
     }},
    {"sin",
     1,
     [](const double* x) {
       return std::sin(x[0]);
     }},
    {"cos",
     1,
     [](const double* x) {
       return std::cos(x[0]);
     }},
    {"sec",
     1,
     [](const double* x) {
       return 1 / std::cos(x[0]);
     }},
    {"csc",
     1,
     [](const double* x) {
       return 1 / std::sin(x[0]);
     }},
    {"tan",
     1,
     [](const double* x) {
       return std::tan(x[0]);
     }},
    {"cot",
     1,
     [](const double* x) {
       return 1 / std::tan(x[0]);
     }},
    {"asin",
     1,
     [](const double* x) {
       return std::asin(x[0]);
     }},
    {"acos",
     1,
     [](const double* x) {
       return std::acos(x[0]);
     }},
    {"atan",
     1,
     [](const double* x) {
       return std::atan(x[0]);
     }},
    {"sinh",
     1,
     [](const double* x) {
       return std::sinh(x[0]);
     }},
    {"cosh",
     1,
     [](const double* x) {
       return std::cosh(x[0]);
     }},
    {"tanh",
     1,
     [](const double* x) {
       return std::tanh(x[0]);
     }},
    {"erf",
     1,
     [](const double* x) {
       return std::erf(x[0]);
     }},
    {"erfc",
     1,
     [](const double* x) {
       return std::erfc(x[0]);
     }},
    {"step",
     1,
     [](const double* x) {
       return calcStep(x[0]);
     }},
    {"delta",
     1,
     [](const double* x) {
       return x[0] == 0 ? 1.0 : 0.0;
     }},
    {"square",
     1,
     [](const double* x) {
       return x[0] * x[0];
     }},
    {"cube",
     1,
     [](const double* x) {
       return x[0] * x[0] * x[0];
     }},
    {"recip",
     1,
     [](const double* x) {
       return 1 / x[0];
     }},
    {"min",
     2,
     [](const double* x) {
       return std::fmin(x[0], x[1]);
     }},
    {"max",
     2,
     [](const double* x) {
       return std::fmax(x[0], x[1]);
     }},
    {"abs",
     1,
     [](const double* x) {
       return std::abs(x[0]);
     }},
    {"atan2",
     2,
     [](const double* x) {
       return std::atan2(x[0], x[1]);
     }},
    {"select",
     3,
     [](const double* x) {
       return x[0] != 0 ? x[1] : x[2];
     }},
}};

}  // namespace

/// Recursive descent with a bound on its depth; writes operands before operations.
class ExpressionParser {
 public:
  ExpressionParser(std::string_view text, const std::vector<std::string>& variables)
      : text_(text), variables_(variables) {}

  std::vector<Expression::Step> parse() {
    if (text_.size() > kMaximumLength) {
      fail("it has " + std::to_string(text_.size()) + " characters, up to " +
           std::to_string(kMaximumLength) + " are read");
    }
    collectDefinitions();
    parseSum();
    requireEnd();
    return std::move(steps_);
  }

 private:
  struct Range {
    std::size_t begin = 0;
    std::size_t end = 0;
  };

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorCode::kModelValue,
                "expression '" + std::string(text_.substr(0, 80)) + "': " + what +
                    " at character " + std::to_string(at_ + 1));
  }

  // The first part is the value; the others define names that it may use.
  void collectDefinitions() {
    std::size_t from = text_.find(';');
    end_ = std::min(from, text_.size());
    while (from < text_.size()) {
      at_ = from + 1;
      const std::size_t next = std::min(text_.find(';', at_), text_.size());
      end_ = next;
      skipBlanks();
      if (at_ < end_) {
        const std::string name = readName();
        skipBlanks();
        if (name.empty() || at_ >= end_ || text_[at_] != '=') {
          fail("expected a definition such as k = 3");
        }
        definitions_[name] = {at_ + 1, next};
      }
      from = next;
    }
    at_ = 0;
    end_ = std::min(text_.find(';'), text_.size());
  }

  void requireEnd() {
    skipBlanks();
    if (at_ < end_) {
      fail(std::string("did not expect '") + text_[at_] + "'");
    }
  }

  void skipBlanks() {
    while (at_ < end_ && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) {
      ++at_;
    }
  }

  bool take(char c) {
    skipBlanks();
    const bool taken = at_ < end_ && text_[at_] == c;
    at_ += taken ? 1 : 0;
    return taken;
  }

  std::string readName() {
    const auto isNameCharacter = [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
    };
    const std::size_t begin = at_;
    while (at_ < end_ && isNameCharacter(text_[at_])) {
      ++at_;
    }
    return std::string(text_.substr(begin, at_ - begin));
  }

  void push(const Expression::Step& step) {
    if (steps_.size() >= kMaximumSteps) {
      fail("it grows beyond " + std::to_string(kMaximumSteps) + " operations");
    }
    steps_.push_back(step);
    stack_ += step.operation < 0
                  ? 1
                  : 1 - kOperations[static_cast<std::size_t>(step.operation)].arguments;
    if (stack_ > kMaximumStack) {
      fail("it needs more than " + std::to_string(kMaximumStack) + " values at a time");
    }
  }
  void pushOperation(int operation) { push({operation, 0, 0}); }

  void parseSum() {
    if (++depth_ > kMaximumDepth) {
      fail("it is nested more than " + std::to_string(kMaximumDepth) + " deep");
    }
    parseProduct();
    for (;;) {
      if (take('+')) {
        parseProduct();
        pushOperation(kAdd);
      } else if (take('-')) {
        parseProduct();
        pushOperation(kSubtract);
      } else {
        break;
      }
    }
    --depth_;
  }

  void parseProduct() {
    parseSigned();
    for (;;) {
      if (take('*')) {
        parseSigned();
        pushOperation(kMultiply);
      } else if (take('/')) {
        parseSigned();
        pushOperation(kDivide);
      } else {
        return;
      }
    }
  }

  void parseSigned() {
    bool negative = false;
    for (;;) {
      if (take('-')) {
        negative = !negative;
      } else if (!take('+')) {
        break;
      }
    }
    parsePower();
    if (negative) {
      pushOperation(kNegate);
    }
  }

  void parsePower() {
    parseValue();
    if (take('^')) {
      if (++depth_ > kMaximumDepth) {
        fail("it is nested more than " + std::to_string(kMaximumDepth) + " deep");
      }
      parseSigned();
      --depth_;
      pushOperation(kPower);
    }
  }

  void parseValue() {
    skipBlanks();
    if (at_ >= end_) {
      fail("expected a value");
    }
    const char c = text_[at_];
    if (take('(')) {
      parseSum();
      close();
    } else if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.') {
      parseNumber();
    } else {
      parseName();
    }
  }

  void close() {
    if (!take(')')) {
      fail("expected ')'");
    }
  }

  void parseNumber() {
    double value = 0;
    const char* begin = text_.data() + at_;
    const auto [stop, error] = std::from_chars(begin, text_.data() + end_, value);
    if (error != std::errc()) {
      fail("expected a number");
    }
    at_ += static_cast<std::size_t>(stop - begin);
    push({kNumber, value, 0});
  }

  void parseName() {
    const std::size_t begin = at_;
    const std::string name = readName();
    if (name.empty()) {
      fail(std::string("did not expect '") + text_[at_] + "'");
    }
    if (take('(')) {
      parseCall(name, begin);
      return;
    }
    const auto variable = std::find(variables_.begin(), variables_.end(), name);
    const auto definition = definitions_.find(name);
    if (variable != variables_.end()) {
      push({kVariable, 0, static_cast<int>(variable - variables_.begin())});
    } else if (definition != definitions_.end()) {
      const Range here{at_, end_};
      at_ = definition->second.begin;
      end_ = definition->second.end;
      parseSum();
      requireEnd();
      at_ = here.begin;
      end_ = here.end;
    } else {
      at_ = begin;
      fail("'" + name + "' is none of the variables " + listVariables());
    }
  }

  void parseCall(const std::string& name, std::size_t begin) {
    const auto operation = std::find_if(
        kOperations.begin() + kFirstFunction, kOperations.end(), [&](const Operation& candidate) {
          return name == candidate.name;
        });
    if (operation == kOperations.end()) {
      at_ = begin;
      fail("there is no function '" + name + "'");
    }
    for (int i = 0; i < operation->arguments; ++i) {
      if (i > 0 && !take(',')) {
        fail("expected ','");
      }
      parseSum();
    }
    close();
    pushOperation(static_cast<int>(operation - kOperations.begin()));
  }

  std::string listVariables() const {
    std::string list;
    for (const std::string& variable : variables_) {
      list += (list.empty() ? "" : ", ") + variable;
    }
    return list;
  }

  std::string_view text_;
  const std::vector<std::string>& variables_;
  std::map<std::string, Range> definitions_;
  std::vector<Expression::Step> steps_;
  std::size_t at_ = 0;
  std::size_t end_ = 0;
  int depth_ = 0;
  int stack_ = 0;
};

Expression::Expression(std::string_view text, const std::vector<std::string>& variables)
    : steps_(ExpressionParser(text, variables).parse()) {}

double Expression::evaluate(const double* values) const {
  std::array<double, kMaximumStack> stack;
  std::size_t count = 0;
  for (const Step& step : steps_) {
    if (step.operation == kNumber) {
      stack[count++] = step.number;
    } else if (step.operation == kVariable) {
      stack[count++] = values[step.variable];
    } else {
      const Operation& operation = kOperations[static_cast<std::size_t>(step.operation)];
      count -= static_cast<std::size_t>(operation.arguments);
      stack[count] = operation.apply(&stack[count]);
      ++count;
    }
  }
  return stack[0];
}

}  // namespace gaitmill
