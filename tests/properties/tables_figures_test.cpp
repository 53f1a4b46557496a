// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The papers' own figures: what they print against what their other numbers give (TABLES).
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "properties/tables/p0.h"
#include "properties/tables/p2.h"
#include "properties/verdict/paper_table.h"

namespace plumbline::tables {
namespace {

const Figure& figure_of(const Table& table, const std::string& row, const std::string& name) {
  for (const Figure& figure : table.figures) {
    if (figure.row == row && figure.name == name) return figure;
  }
  throw std::logic_error("no figure " + row + ", " + name);
}

std::string recomputed_text(const Table& table, const std::string& row, const std::string& name,
                            int decimals) {
  return figure_text(figure_of(table, row, name).recomputed.value(), decimals);
}

TEST(PrintedFigure, BlanksGroupDigits) {
  EXPECT_EQ(printed_number("20 569"), 20569);
  EXPECT_EQ(printed_number("33 554 432"), 33554432);
  EXPECT_EQ(printed_number("4.6"), 4.6);
  EXPECT_EQ(printed_number("0.50"), 0.5);
}

TEST(PrintedFigure, AnythingElseIsRefused) {
  for (const char* text : {"", " ", ".", "-", "4,6", "1e3", "4.6.1", "4.6 7", "nan"}) {
    EXPECT_THROW(printed_number(text), std::invalid_argument) << '"' << text << '"';
  }
}

TEST(PrintedFigure, AgreesByRoundingByTruncationOrNotAtAll) {
  EXPECT_EQ(agreement_of("4.5", 4.484), Agreement::rounded);
  EXPECT_EQ(agreement_of("4.4", 4.484), Agreement::truncated);
  EXPECT_EQ(agreement_of("4.6", 4.484), Agreement::misprint);
  EXPECT_EQ(agreement_of("4.3", 4.484), Agreement::misprint);
  EXPECT_EQ(agreement_of("524 288", 524288), Agreement::rounded);
  EXPECT_EQ(agreement_of("524 289", 524288), Agreement::misprint);
}

TEST(PrintedFigure, IsWrittenAsThePapersDo) {
  EXPECT_EQ(figure_text(524288, 0), "524 288");
  EXPECT_EQ(figure_text(33554432, 0), "33 554 432");
  EXPECT_EQ(figure_text(999, 0), "999");
  EXPECT_EQ(figure_text(1000.5, 2), "1 000.50");
  EXPECT_EQ(figure_text(-1234, 0), "-1 234");
  EXPECT_EQ(figure_text(0.344, 3), "0.344");
}

TEST(TableP0, PercentagesFollowFromTheCounts) {
  const Table table = p0_table({});
  EXPECT_EQ(recomputed_text(table, "6a", "full triangles", 0), "524 288");
  EXPECT_EQ(recomputed_text(table, "6", "ATL share of full", 2), "7.35");
  EXPECT_EQ(recomputed_text(table, "7", "ATL share of full", 2), "3.92");
  EXPECT_EQ(recomputed_text(table, "8", "ATL share of full", 2), "1.33");
  EXPECT_EQ(recomputed_text(table, "7", "QUADTin share of full", 2), "4.48");
  EXPECT_EQ(recomputed_text(table, "8", "QUADTin share of full", 2), "1.42");
  EXPECT_EQ(recomputed_text(table, "7", "QUADTin : ATL, same p99", 3), "1.143");
  EXPECT_EQ(recomputed_text(table, "8", "QUADTin : ATL, same p99", 3), "1.063");
}

TEST(TableP0, TheOneMisprintIsFigure7bsPercentage) {
  const Table table = p0_table({});
  int checked = 0;
  for (const Figure& figure : table.figures) {
    const Agreement agreement = figure.agreement();
    if (agreement == Agreement::not_checked) continue;
    ++checked;
    const bool the_one = figure.row == "7" && figure.name == "QUADTin share of full";
    EXPECT_EQ(agreement, the_one ? Agreement::misprint : Agreement::rounded) << figure.row << figure.name;
  }
  EXPECT_EQ(checked, 6);  // full, three shares of ATL, two of QUADTin
  EXPECT_EQ(figure_of(table, "7", "QUADTin share of full").printed, "4.6");
}

TEST(TableP2, Table1sQuotientsFollowFromItsColumns) {
  const Table table = p2_table1({}, {});
  EXPECT_EQ(recomputed_text(table, "full", "full triangles", 0), "2 097 152");
  EXPECT_EQ(recomputed_text(table, "ε = 4", "triangles per node", 3), "8.748");
  EXPECT_EQ(recomputed_text(table, "ε = 3", "triangles per node", 3), "8.744");
  EXPECT_EQ(recomputed_text(table, "ε = 2", "triangles per node", 3), "8.713");
  EXPECT_EQ(recomputed_text(table, "ε = 2 : ε = 4", "nodes drawn", 1), "2.4");
}

TEST(TableP2, EveryPercentageOfTable1AgreesButOneIsCutOff) {
  const Table table = p2_table1({}, {});
  EXPECT_EQ(figure_of(table, "ε = 4", "share of full").agreement(), Agreement::rounded);
  EXPECT_EQ(figure_of(table, "ε = 3", "share of full").agreement(), Agreement::truncated);
  EXPECT_EQ(recomputed_text(table, "ε = 3", "share of full", 2), "0.51");
  EXPECT_EQ(figure_of(table, "ε = 2", "share of full").agreement(), Agreement::rounded);
}

TEST(TableP2, EveryPercentageOfTable2Agrees) {
  for (const Relief relief : {Relief::own, Relief::fitted}) {
    const Table table = p2_table2({}, {}, relief);
    EXPECT_EQ(recomputed_text(table, "full", "full triangles", 0), "33 554 432");
    for (const char* frame : {"frame 1", "frame 2", "frame 3", "frame 4", "frame 5", "frame 6"}) {
      EXPECT_EQ(figure_of(table, frame, "share of full").agreement(), Agreement::rounded) << frame;
    }
    EXPECT_EQ(recomputed_text(table, "frame 6 : 1", "triangles", 2), "2.27");
  }
}

TEST(TableP2, NoMoreIsCalledFittedThanTheProtocolFits) {
  const auto fitted = [](const Table& table) {
    std::string names;
    for (const Figure& figure : table.figures) {
      if (figure.kind == Kind::fitted) names += figure.row + ", " + figure.name + "; ";
    }
    return names;
  };
  EXPECT_EQ(fitted(p2_table1({}, {})), "ε = 4, triangles; ");
  EXPECT_EQ(fitted(p2_table2({}, {}, Relief::own)), "frame 1, tiles visible; ");
  EXPECT_EQ(fitted(p2_table2({}, {}, Relief::fitted)), "frame 1, triangles; ");
  EXPECT_EQ(fitted(p0_table({})), "6, ATL triangles; 7, ATL triangles; 8, ATL triangles; ");
}

TEST(Ratio, IsToTheRecomputedFigureWhereThereIsOne) {
  Figure figure;
  figure.printed = "4.6";
  EXPECT_EQ(ratio(figure, 4.6), 1);
  figure.recomputed = 4.5;
  EXPECT_EQ(ratio(figure, 9.0), 2);
  EXPECT_FALSE(ratio(figure, std::nullopt));
  EXPECT_FALSE(ratio(Figure{}, 1.0));
  figure.recomputed = 0;
  EXPECT_FALSE(ratio(figure, 1.0));
}

}  // namespace
}  // namespace plumbline::tables
