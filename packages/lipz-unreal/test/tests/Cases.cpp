// The playback cases of the repository: visemes, segments, texts and events.

#include "LipzPlayback.h"
#include "LipzStrings.h"
#include "Stage.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>

static lipz_time TimeOf(std::istringstream& Words)
{
	std::string Unit, Number;
	Words >> Unit >> Number;
	if (Unit == "us") return lipz_time_us(std::stoll(Number));
	if (Unit == "seconds") return lipz_time_seconds(std::strtod(Number.c_str(), nullptr));
	if (Unit == "f32") return lipz_time_seconds_f32(std::strtof(Number.c_str(), nullptr));
	uint32 Rate = 0;
	Words >> Rate;
	return lipz_time_samples(std::stoll(Number), Rate);
}

/** One section of the cases. */
class FCase
{
public:
	/** Runs a command, and returns the answer. Returns false if this test lacks the command. */
	bool Run(const std::string& Line, std::string& Out)
	{
		std::istringstream Words(Line);
		std::string Command, Word;
		Words >> Command;
		Out.clear();
		if (Command == "bank")
		{
			Words >> Word;
			Bank = OpenFixture(Word);
			return true;
		}
		if (Command == "locale") return static_cast<bool>(Words >> Locale);
		if (Command == "speaker" || Command == "clip")
		{
			if (Command == "clip") Speaker.clear(), Words >> Key;
			else Words >> Speaker;
			LeadFrames = 0;
			bHolds = false;
			Word.clear();
			std::getline(Words, Word);
			if (!Word.empty() || !Bank->GetDialogue()->FindClip(ToFString(Key), Clip)) return false;
			if (!Playback.Start(*Bank->GetDialogue(), Clip, ToFString(Speaker))) Out = "  no frame rate\n";
			return true;
		}
		if (Command == "lead" || Command == "hold")
		{
			Words >> Word;
			if (Word != "one" && Word != "two" && Word != "readable") return false;
			if (Command == "lead") LeadFrames = Word == "one" ? 1 : 2;
			else bHolds = true;
			Playback.SetLeadAndHold(*Bank->GetDialogue(), Clip, LeadFrames, bHolds);
			return true;
		}
		const FLipzDialogue& Dialogue = *Bank->GetDialogue();
		if (Command == "advance") Playback.AdvanceTo(Dialogue, TimeOf(Words));
		else if (Command == "loop") Playback.LoopTo(Dialogue, TimeOf(Words));
		else if (Command == "seek") Playback.Seek(Dialogue, TimeOf(Words));
		else if (Command == "finish") Playback.Finish(Dialogue);
		else return false;
		Out = Answer(Dialogue);
		return true;
	}

private:
	std::string Answer(const FLipzDialogue& Dialogue)
	{
		std::string Out = "  viseme " + std::string(1, static_cast<char>(Playback.GetViseme(Dialogue)));
		lipz_segment Segment;
		if (Playback.FindSegment(Dialogue, Segment))
		{
			Out += ", segment " + std::to_string(Segment.index);
			if (!Locale.empty()) Out += ": " + Bank->GetText(ToFString(Key), static_cast<int32>(Segment.index), ToFString(Locale)).ToString().Utf8();
		}
		Out += "\n";
		FLipzEvent Event;
		while (Playback.TakeEvent(Dialogue, Event))
		{
			if (Event.Verb != ELipzVerb::Other) Out += "  event " + Words(Event) + "\n";
		}
		return Out;
	}

	ULipzBank* Bank = nullptr;
	FLipzPlayback Playback;
	lipz_clip Clip = {};
	int32 LeadFrames = 0;
	bool bHolds = false;
	std::string Key, Speaker, Locale;
};

/** The part of an expected answer that the plugin has: without frame, openness and strings of events. */
static std::string Reduced(const std::string& Expected)
{
	std::string Out, Line;
	std::istringstream Lines(Expected);
	while (std::getline(Lines, Line))
	{
		const size_t Viseme = Line.find("viseme ");
		if (Line.rfind("  event ", 0) == 0 || Line == "  no frame rate") Out += Line + "\n";
		if (Line.rfind("  frame ", 0) != 0) continue;
		// After the openness, if there is one, follows the segment.
		const size_t Segment = Line.find(", segment ");
		const std::string Rest = Segment == std::string::npos ? "" : Line.substr(Segment);
		const size_t Fallback = Rest.find(" (fallback)");
		Out += "  " + Line.substr(Viseme, 8) + Rest.substr(0, Fallback) + "\n";
	}
	return Out;
}

void TestCases()
{
	std::ifstream File(Root + "/fixtures/playback/cases.txt");
	std::vector<std::pair<std::string, std::string>> Commands; // with their expected answers
	std::string Line;
	while (std::getline(File, Line))
	{
		if (Line.empty() || (Line[0] == '#' && Line[1] != '#')) continue;
		if (Line[0] == ' ') Commands.back().second += Line + "\n";
		else Commands.push_back({Line, ""});
	}
	int Run = 0, Skipped = 0;
	FCase Case;
	bool bIsSkipped = false;
	const std::map<std::string, bool> Needed = {{"needs states", true}, {"needs lead", true}, {"needs hold", true}, {"needs hold lead", true}};
	for (const auto& [Command, Expected] : Commands)
	{
		if (Command[0] == '#') Case = FCase(), bIsSkipped = false;
		else if (Command.rfind("needs", 0) == 0) bIsSkipped = Needed.count(Command) == 0;
		else if (bIsSkipped) Skipped++;
		else
		{
			std::string Actual;
			const bool bIsKnown = Case.Run(Command, Actual);
			// Frame rates and types that a program sets, other leads and holds, and states are not in the plugin.
			bIsSkipped = !bIsKnown && Command.rfind("state", 0) != 0 && Command.rfind("characters", 0) != 0;
			(bIsKnown ? Run : Skipped)++;
			if (!bIsKnown) continue;
			std::string Known = Reduced(Expected);
			// An event without a character belongs to the speaker, even if no event names that character.
			for (size_t At; (At = Actual.find("event nobody-in-this-bank ")) != std::string::npos;) Actual.erase(At + 6, 20);
			ExpectSame(Command + "\n" + Actual, Command + "\n" + Known, "cases.txt", Run);
		}
	}
	std::printf("cases.txt: %d commands, %d skipped\n", Run, Skipped);
	EXPECT(Run > 100);
}
