#pragma once

namespace gaitmill {

/// Position in one kind of list. Two kinds do not convert into each other, so that swapping a
/// body and a coordinate index does not compile. Invalid is −1.
template <class Tag>
class Index {
 public:
  constexpr Index() = default;
  constexpr explicit Index(int value) : value_(value) {}
  constexpr int value() const { return value_; }
  constexpr bool isValid() const { return value_ >= 0; }
  friend constexpr bool operator==(Index a, Index b) { return a.value_ == b.value_; }
  friend constexpr bool operator!=(Index a, Index b) { return a.value_ != b.value_; }
  friend constexpr bool operator<(Index a, Index b) { return a.value_ < b.value_; }

 private:
  int value_ = -1;
};

using BodyIndex = Index<struct BodyTag>;              ///< ModelSpec::bodies; ground is kGround
using CoordinateIndex = Index<struct CoordinateTag>;  ///< model coordinate order
using MuscleIndex = Index<struct MuscleTag>;          ///< ModelSpec::muscles
using MarkerIndex = Index<struct MarkerTag>;          ///< ModelSpec::markers

/// Ground as a body: the only invalid-looking index that is meant.
inline constexpr BodyIndex kGround{-1};

}  // namespace gaitmill
