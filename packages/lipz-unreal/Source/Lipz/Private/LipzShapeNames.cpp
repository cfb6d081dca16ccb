#include "LipzShapeNames.h"

namespace
{
	/** The letters and digits of a name in lower case. */
	FString Letters(const FString& Name)
	{
		FString Result;
		for (const TCHAR Character : Name.ToLower())
		{
			if (FChar::IsAlnum(Character) || Character > 127)
			{
				Result.AppendChar(Character);
			}
		}
		return Result;
	}

	/** The name without those of meshes and deformers before it: `blendShape1.jawOpen`. */
	FString WithoutPath(const FString& Name)
	{
		int32 Start = 0;
		for (int32 Index = 0; Index + 1 < Name.Len(); Index++)
		{
			const TCHAR Character = Name[Index];
			if (Character == TEXT('.') || Character == TEXT(':') || Character == TEXT('|') || Character == TEXT('/'))
			{
				Start = Index + 1;
			}
		}
		return Name.Mid(Start);
	}

	/** The name with `Left` or `Right` for the short form of a side at its end: `mouthSmile_L`. */
	FString WithSide(const FString& Name)
	{
		const int32 Length = Name.Len();
		if (Length < 3)
		{
			return Name;
		}
		const TCHAR Last = Name[Length - 1];
		const TCHAR Before = Name[Length - 2];
		const bool bIsSeparate = Before == TEXT('_') || Before == TEXT('-') || Before == TEXT(' ');
		const bool bIsCapital = (Last == TEXT('L') || Last == TEXT('R')) && FChar::IsLower(Before);
		const bool bIsSide = Last == TEXT('L') || Last == TEXT('R') || Last == TEXT('l') || Last == TEXT('r');
		if (!bIsSide || !(bIsSeparate || bIsCapital))
		{
			return Name;
		}
		return Name.Left(Length - 1) + (Last == TEXT('L') || Last == TEXT('l') ? TEXT("Left") : TEXT("Right"));
	}

	/** The name without the kind of the shape before it: `viseme_aa`. */
	FString WithoutKind(const FString& Name)
	{
		const TCHAR* const Kinds[] = {TEXT("arkit"), TEXT("viseme"), TEXT("mouth"), TEXT("phoneme"), TEXT("lipsync"), TEXT("v")};
		for (const TCHAR* const Kind : Kinds)
		{
			const FString Start(Kind);
			if (Name.StartsWith(Start + TEXT("_")) || Name.StartsWith(Start + TEXT("-")))
			{
				return Name.Mid(Start.Len() + 1);
			}
		}
		return Name;
	}

	/** The name in a form that is compared; the higher the degree, the less similar the names. */
	FString Form(const FString& Name, int32 Degree)
	{
		switch (Degree)
		{
		case 0:
			return Letters(Name);
		case 1:
			return Letters(WithoutPath(Name));
		case 2:
			return Letters(WithSide(WithoutPath(Name)));
		default:
			return Letters(WithoutKind(WithSide(WithoutPath(Name))));
		}
	}
}

int32 LipzShapeNames::Find(const FString& Weight, const TArray<FString>& Names)
{
	const FString Wanted = Letters(Weight);
	for (int32 Degree = 0; Degree < 4 && !Wanted.IsEmpty(); Degree++)
	{
		for (int32 Index = 0; Index < Names.Num(); Index++)
		{
			if (Form(Names[Index], Degree) == Wanted)
			{
				return Index;
			}
		}
	}
	return INDEX_NONE;
}
