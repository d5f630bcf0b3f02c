from gen2 import *
os.makedirs('m2c',exist_ok=True)
run2('m2c/slow4.csv',[4,-4],1.1); run2('m2c/brake4.csv',[4,-4],1.1,brake=.045); run2('m2c/brake4s.csv',[4,-4],1.1,brake=.02)
