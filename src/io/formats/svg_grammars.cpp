// The grammars by which svg_reader.cpp has svgpp read attributes, in the way that svgpp provides
// for compiling them apart.
#include <svgpp/factory/icc_color_stub.hpp>
#include <svgpp/factory/integer_color.hpp>
#include <svgpp/factory/unitless_length.hpp>
#include <svgpp/parser/external_function/parse_length_impl.hpp>
#include <svgpp/parser/external_function/parse_misc_impl.hpp>
#include <svgpp/parser/external_function/parse_paint_impl.hpp>
#include <svgpp/parser/external_function/parse_path_data_impl.hpp>
#include <svgpp/parser/external_function/parse_preserveAspectRatio_impl.hpp>
#include <svgpp/parser/external_function/parse_transform_impl.hpp>

SVGPP_PARSE_PATH_DATA_IMPL(const char*, double)
SVGPP_PARSE_TRANSFORM_IMPL(const char*, double)
SVGPP_PARSE_PRESERVE_ASPECT_RATIO_IMPL(const char*)
SVGPP_PARSE_MISC_IMPL(const char*, double)
SVGPP_PARSE_LENGTH_IMPL(const char*, svgpp::factory::length::unitless<>)
SVGPP_PARSE_PAINT_IMPL(const char*, svgpp::factory::color::integer<>,
                       svgpp::factory::icc_color::stub)
