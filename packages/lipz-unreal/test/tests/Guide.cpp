// The program of the guide, with the output that the guide shows.

#include "Stage.h"
#include "Talker.h"

#include <fstream>
#include <sstream>

void TestGuide()
{
	FStage Stage("drama");
	ATalker* Talker = NewObject<ATalker>();
	Talker->StubAdd(Stage.Audio);
	Talker->StubAdd(Stage.Player);
	Talker->Player = Stage.Player;
	Talker->Recording = Stage.Sound;
	Stage.Player->Speaker = TEXT("mara");
	StubLog.clear();
	Talker->BeginPlay();
	for (int Frame = 0; Frame <= 400; Frame++)
	{
		Stage.Audio->StubReport(Stage.Sound, static_cast<float>(Frame) / 400.0f);
		Stage.Tick(0.01);
	}
	Stage.Audio->Stop();
	Stage.Tick(0.01);
	std::string Printed;
	for (const std::string& Line : StubLog) Printed += Line.substr(0, Line.find_last_not_of(' ') + 1) + "\n";
	std::ifstream File(EXPECTED_OF_GUIDE);
	std::ostringstream Expected;
	Expected << File.rdbuf();
	EXPECT_SAME(Printed, Expected.str());
}
