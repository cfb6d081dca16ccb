// Damaged banks: the words of lipz, and never a crash.

#include "LipzDialogue.h"
#include "LipzStrings.h"
#include "Stage.h"

#include <cctype>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>

/** The sentence about each kind of damage, by its name in damaged.txt. */
static std::map<std::string, std::string> Sentences()
{
	std::map<std::string, std::string> Result;
	std::ifstream Header(Root + "/crates/lipz-capi/include/lipz.h");
	std::string Line, Define, Name;
	uint32 Number;
	while (std::getline(Header, Line) && Result.size() < 46)
	{
		std::istringstream Words(Line);
		if (!(Words >> Define >> Name >> Number) || Define != "#define" || Number != Result.size() + 1) continue;
		std::string Kind;
		for (size_t I = 5; I < Name.size(); I++)
		{
			if (Name[I] == '_') continue;
			Kind.push_back(Name[I - 1] == '_' ? Name[I] : static_cast<char>(std::tolower(Name[I])));
		}
		Result[Kind] = LipzStrings::Message(Number).Utf8();
	}
	return Result;
}

static std::vector<uint8> FromHex(const std::string& Hex)
{
	std::vector<uint8> Bytes;
	for (size_t I = 0; I + 1 < Hex.size(); I += 2) Bytes.push_back(static_cast<uint8>(std::stoi(Hex.substr(I, 2), nullptr, 16)));
	return Bytes;
}

/** A bank that is damaged by the commands of damaged.txt. */
class FDamagedBank
{
public:
	void Take(const std::string& Name)
	{
		Fixture = Name;
		Original = ReadFixture(Name + ".lipzbank");
		Bytes = Original;
	}

	void Damage(const std::string& Command, std::istringstream& Words)
	{
		std::string Tag, Hex;
		size_t At = 0;
		if (Command == "cut")
		{
			Words >> At;
			Bytes.SetNumZeroed(std::min(static_cast<int32>(At), Bytes.Num()));
			return;
		}
		if (Command == "append")
		{
			Words >> Hex;
			for (const uint8 Byte : FromHex(Hex)) Bytes.Add(Byte);
			return;
		}
		if (Command != "put") Words >> Tag;
		Words >> At >> Hex;
		if (Command == "section") At += Number(EntryOf(Tag) + 4);
		if (Command == "entry") At += EntryOf(Tag);
		for (const uint8 Byte : FromHex(Hex))
		{
			if (At < static_cast<size_t>(Bytes.Num())) Bytes[static_cast<int32>(At)] = Byte;
			At++;
		}
	}

	std::string Fixture;
	TArray<uint8> Original;
	TArray<uint8> Bytes;

private:
	size_t Number(size_t At) const
	{
		size_t Result = 0;
		for (size_t I = 4; I-- > 0;) Result = Result << 8 | Original[static_cast<int32>(At + I)];
		return Result;
	}

	/** The entry of a section in the directory, which starts at 64. */
	size_t EntryOf(const std::string& Tag) const
	{
		for (size_t At = 64; At + 16 <= 64 + 16 * Number(40); At += 16)
		{
			if (Tag == std::string(reinterpret_cast<const char*>(&Original[static_cast<int32>(At)]), 4)) return At;
		}
		EXPECT_SAME("no section", Tag);
		return 0;
	}
};

/** Asks everything of a bank, whether it is open or not. */
static void AskAll(const ULipzBank* Bank)
{
	for (const FString& Key : Bank->GetClipKeys(TEXT("")))
	{
		Bank->GetClipSeconds(Key);
		Bank->GetVisemeAt(Key, 0.1f);
		Bank->GetText(Key, 0, TEXT("de-de"));
		Bank->GetCurveAt(Key, TEXT("jawOpen"), 0.1f);
	}
	Bank->GetLocales();
}

/** Returns the error of a bank with these bytes. A different bank refuses them too, and stays as it is. */
static std::string ErrorOf(const TArray<uint8>& Bytes, ULipzBank* Kept)
{
	ULipzBank* Bank = NewObject<ULipzBank>();
	FString Error, Again;
	const bool bIsOpen = Bank->SetContents(Bytes, Error);
	EXPECT(bIsOpen == Error.IsEmpty());
	EXPECT(bIsOpen || (!Kept->SetContents(Bytes, Again) && Again == Error && Kept->HasClip(TEXT("act1/mara-good-evening"))));
	AskAll(Bank);
	return Error.Utf8();
}

static std::string Answer(std::ifstream& File)
{
	std::string Line;
	std::getline(File, Line);
	return Line.substr(2);
}

static void TestFile()
{
	const auto Words = Sentences();
	EXPECT(Words.size() == 46);
	const auto Sentence = [&](const std::string& Kind, int File) {
		const size_t Space = Kind.find(" at ");
		return Words.at(Kind.substr(0, Space)) + " (file " + std::to_string(File) + ", byte " + Kind.substr(Space + 4) + ")";
	};
	std::ifstream File(Root + "/fixtures/banks/damaged.txt");
	FDamagedBank Bank;
	std::string Line, Command, Name;
	int Refused = 0, Changed = 0, Skipped = 0;
	bool bIsSealed = false;
	while (std::getline(File, Line))
	{
		std::istringstream Rest(Line);
		if (!(Rest >> Command) || Line[0] == '#' || Line[0] == ' ' || Command == "needs") continue;
		if (Command == "bank")
		{
			Rest >> Name;
			Bank.Take(Name);
			bIsSealed = false;
		}
		else if (Command == "seal")
		{
			bIsSealed = true; // this test cannot compute the checksum
		}
		else if (Command == "open" || Command == "verify")
		{
			const std::string Expected = Answer(File);
			const std::string Error = ErrorOf(Bank.Bytes, OpenFixture("drama"));
			// A player verifies what it opens. So if it only opens, all errors of the verification are allowed.
			const bool bIsKnown = !bIsSealed && (Command == "verify" || Expected != "opens");
			Skipped += bIsKnown ? 0 : 1;
			if (bIsKnown) EXPECT_SAME(Error, Expected == "verified" ? "" : Sentence(Expected, 0));
			Refused += bIsKnown && !Error.empty() ? 1 : 0;
		}
		else if (Command == "texts")
		{
			Rest >> Name;
			const std::string Expected = Answer(File);
			// The damage is that of the texts. Only undamaged ones can be made here.
			if (Bank.Bytes.Num() != Bank.Original.Num() || Expected.rfind("Other", 0) == std::string::npos) continue;
			if (!std::equal(Bank.Bytes.begin(), Bank.Bytes.end(), Bank.Original.begin())) continue;
			ULipzBank* Base = OpenFixture(Bank.Fixture);
			FString Error;
			EXPECT(!Base->AddFile(ReadFixture(Name + ".lipztexts"), Error));
			EXPECT_SAME(Error.Utf8(), Sentence(Expected, 1));
		}
		else if (Command == "each-byte")
		{
			ULipzBank* Kept = OpenFixture("drama");
			for (int32 At = 0; At < Bank.Original.Num(); At++, Changed++)
			{
				TArray<uint8> Bytes = Bank.Original;
				Bytes[At] = static_cast<uint8>(~Bytes[At]);
				EXPECT(!ErrorOf(Bytes, Kept).empty());
			}
			StubCollectGarbage();
		}
		else
		{
			Bank.Damage(Command, Rest);
		}
	}
	std::printf("damaged.txt: %d refused with its words, %d only opened; %d changed bytes, all refused\n", Refused, Skipped, Changed);
	EXPECT(Refused > 100);
}

static void TestPlayerWithDamagedBank()
{
	FStage Stage("drama");
	TArray<uint8> Bytes = ReadFixture("drama.lipzbank");
	Bytes[Bytes.Num() / 2] ^= 1;
	FString Error;
	ULipzBank* Damaged = NewObject<ULipzBank>();
	EXPECT(!Damaged->SetContents(Bytes, Error));
	EXPECT_SAME(Error.Utf8().substr(0, 27), "the checksum does not match");
	Stage.Player->Bank = Damaged;
	EXPECT(!Stage.Player->Play(TEXT("act1/mara-good-evening")));
	EXPECT(!Stage.Player->Begin(TEXT("act1/mara-good-evening")));
	EXPECT(!Stage.Player->PlayWithSound(TEXT("act1/mara-good-evening"), Stage.Sound));
	Stage.Player->Bank = nullptr;
	EXPECT(!Stage.Player->Play(TEXT("act1/mara-good-evening")));
	Stage.Tick(1.0);
	Stage.Player->Seek(1.0f);
	Stage.Player->SetPaused(true);
	Stage.Player->Stop();
	EXPECT_SAME(Stage.Take(), "");
}

void TestDamage()
{
	TestFile();
	TestPlayerWithDamagedBank();
}
