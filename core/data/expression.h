#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gaitmill {

/// A formula of named variables, as model documents hold it: + - * / ^, parentheses, numbers, the
/// functions sqrt exp log sin cos sec csc tan cot asin acos atan sinh cosh tanh erf erfc step delta
/// square cube recip min max abs atan2 select, and definitions of names behind
/// semicolons ("k*q; k = 3"). -x^2 is -(x^2), and ^ groups from the right. Parsed once; immutable.
class Expression {
 public:
  /// @param variables  names that values are given for, in the order of evaluate()
  /// @throws Error kModelValue saying what is wrong at which character; also beyond 2000
  ///   characters, 32 levels of nesting or 64 values at a time
  Expression(std::string_view text, const std::vector<std::string>& variables);

  /// @param values  as many as variables. What has no value (log of -1) is NaN. Does not allocate.
  double evaluate(const double* values) const;

 private:
  friend class ExpressionParser;
  struct Step {
    int operation = 0;  ///< which of the operations, or a number, or a variable
    double number = 0;  ///< of a number
    int variable = 0;   ///< position of a variable
  };
  std::vector<Step> steps_;  ///< operands before operations
};

}  // namespace gaitmill
