# cmake -DROOT=… -DOUTPUT=… -P source_hash.cmake: writes the SHA-256 over names and contents of every
# source of the core, in alphabetical order, as a constant.
file(GLOB_RECURSE sources RELATIVE ${ROOT} ${ROOT}/core/*.cc ${ROOT}/core/*.h ${ROOT}/core/*.inc)
list(SORT sources)
set(lines "")
foreach(source ${sources})
  file(SHA256 ${ROOT}/${source} hash)
  string(APPEND lines "${hash}  ${source}\n")
endforeach()
string(SHA256 total "${lines}")
file(WRITE ${OUTPUT}
  "#include \"core/pipeline/source_hash.h\"\n\n"
  "namespace gaitmill {\n\n"
  "const char* const kCoreSourceHash = \"${total}\";\n\n"
  "}  // namespace gaitmill\n")
