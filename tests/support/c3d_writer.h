#pragma once

#include <string>
#include <vector>

namespace gaitmill {

/// Writes C3D files for tests: any processor and storage, any parameters, and counts that may lie.
class C3dWriter {
 public:
  enum class Processor { kIntel = 84, kDec = 85, kMips = 86 };

  Processor processor = Processor::kIntel;
  bool is_real = true;       ///< storage of points and analog samples
  double point_scale = 0.1;  ///< length unit per integer, > 0 also for reals
  double rate = 100;         ///< [Hz]
  int subframes = 1;         ///< analog samples per frame
  int first_frame = 1;
  /// (frames x 4 points): x, y, z in the length unit (divided by the scale when stored as integers)
  /// and the fourth word as it is
  std::vector<std::vector<double>> points;
  /// (frames subframes x channels) raw values
  std::vector<std::vector<double>> analog;

  // What the header says; -1 = the truth.
  int header_points = -1;
  int header_samples = -1;  ///< analog samples per frame, all channels
  int header_subframes = -1;
  int header_last_frame = -1;

  void addTexts(const std::string& group,
                const std::string& name,
                const std::vector<std::string>& texts);
  void addWords(const std::string& group,
                const std::string& name,
                const std::vector<int>& dimensions,
                const std::vector<int>& values);
  void addReals(const std::string& group,
                const std::string& name,
                const std::vector<int>& dimensions,
                const std::vector<double>& values);

  /// POINT:USED, SCALE, RATE, UNITS mm and LABELS as the members say.
  void addPointGroup(const std::vector<std::string>& labels);
  /// ANALOG:USED, RATE, LABELS and UNITS, scales of 1 and offsets of 0.
  void addAnalogGroup(const std::vector<std::string>& labels,
                      const std::vector<std::string>& units);
  /// One plate with its corners [mm] and the channels 1, 2, ...
  void addPlate(int type,
                const std::vector<double>& corners,
                const std::vector<double>& origin,
                int channel_count);

  std::string write() const;

 private:
  void beginRecord(std::string& bytes, int id, const std::string& name) const;
  std::string writeParameters() const;
  void putWord(std::string& bytes, long value) const;
  void putReal(std::string& bytes, double value) const;
  void putSample(std::string& bytes, double value) const;

  struct Parameter {
    std::string group;
    std::string name;
    int type;
    std::vector<int> dimensions;
    std::string text;             // type -1
    std::vector<double> numbers;  // types 2 and 4
  };
  std::vector<Parameter> parameters_;
};

}  // namespace gaitmill
