using NUnit.Framework;

namespace Lipz.Tests
{
    /// <summary>Tests of the reader for the Test Runner of Unity: is the package intact on this platform?</summary>
    public sealed class BankTests
    {
        /// <summary>The visemes of all frames, and rest outside.</summary>
        [Test]
        public void VisemesAreThoseOfTheFile()
        {
            Clip clip = Bank.Open(TinyBank.Bytes).Clip("hi");
            string visemes = "";
            for (int us = -50000; us < 200000; us += 50000) visemes += clip.VisemeAt(ClipTime.Micros(us));
            Assert.AreEqual("-MA--", visemes);
        }

        /// <summary>Samples and seconds find the same frames.</summary>
        [Test]
        public void AllUnitsOfTimeFindTheSameFrame()
        {
            Clip clip = Bank.Open(TinyBank.Bytes).Clip("hi");
            Assert.AreEqual('A', clip.VisemeAt(ClipTime.Samples(2000, 48000)));
            Assert.AreEqual('A', clip.VisemeAt(ClipTime.Seconds(1.0 / 24)));
            Assert.AreEqual('A', clip.VisemeAt(ClipTime.Seconds(1f / 24)));
        }

        /// <summary>The text and the event of the only segment.</summary>
        [Test]
        public void SegmentsHaveTextsAndEvents()
        {
            Bank bank = Bank.Open(TinyBank.Bytes);
            Segment segment = bank.Clip("hi").Segment(0).Value;
            Assert.AreEqual("Hi", segment.Text(bank.Locale("en-us")).Value.Text);
            Assert.AreEqual("feels sad", segment.Event);
            Assert.IsNull(bank.Locale("de-de"));
            Assert.IsNull(bank.Clip("ho"));
        }

        /// <summary>A damaged bank is an error with the position of the damage.</summary>
        [Test]
        public void DamageIsReported()
        {
            byte[] bytes = TinyBank.Bytes;
            bytes[0x384] ^= 1;
            BankException error = Assert.Throws<BankException>(() => Bank.Open(bytes).VerifyChecksum());
            Assert.AreEqual(BankErrorKind.Checksum, error.Kind);
            bytes[0] = 0;
            Assert.AreEqual(0L, Assert.Throws<BankException>(() => Bank.Open(bytes)).OffsetBytes);
        }
    }
}
